// SPDX-License-Identifier: MIT
#include "preview_flag.h"

#include <algorithm>
#include <array>

#include "vantage/report/view_report.h"

#include "option_text.h"
#include "terminal_picture.h"

namespace vantage::cli {
namespace {

constexpr std::array<const char*, 4> kProtocols{"blocks", "kitty", "iterm", "sixel"};

}  // namespace

void PreviewFlag::add_to(CLI::App& app) {
  // A flag that may be given a value by =, so that it never swallows the model's name.
  const std::vector<std::string> words{"auto", "blocks", "kitty", "iterm", "sixel"};
  CLI::Option* const flag =
      app.add_flag(
             "--preview{auto}", protocol_,
             "show the picture in the terminal; --preview=blocks, kitty, iterm or sixel if it is "
             "not found out what the terminal knows")
          ->check(CLI::IsMember(words))
          ->group("Pictures");
  offer_values(flag, words);
}

void PreviewFlag::show(Session& session, const ShapeAnalysis& shape, const Camera& camera,
                       const ViewOptions& options, PictureLook look, const RunContext& run) const {
  if (protocol_.empty() || session.flags.json || session.flags.quiet) {
    return;
  }
  const auto* const named = std::find(kProtocols.begin(), kProtocols.end(), protocol_);
  const PictureProtocol protocol =
      named == kProtocols.end()
          ? terminal_protocol()
          : static_cast<PictureProtocol>(std::distance(kProtocols.begin(), named));
  ViewOptions small = options;
  const PictureExtent extent = picture_extent(protocol, terminal_size(),
                                              static_cast<double>(options.width) / options.height);
  small.width = extent.width;
  small.height = extent.height;
  // Few pixels, each worth many rays.
  set_quality(look.render, protocol == PictureProtocol::Blocks ? Quality::Fine : Quality::Normal);
  const Image image =
      draw_picture(shape, camera, Picture::Plain, small, look.render, run, look.asset);
  std::string text = terminal_picture(image, protocol);
  text.pop_back();  // the line's end comes with the message
  session.show(text);
}

}  // namespace vantage::cli
