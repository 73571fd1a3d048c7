// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

#include "vantage/render/colour_map.h"
#include "vantage/render/framing.h"
#include "vantage/render/render.h"
#include "vantage/report/comparison.h"

namespace vantage {
namespace {

constexpr int kTileWidth = 240;   // px
constexpr int kTileHeight = 180;  // px
constexpr int kGap = 8;           // px
constexpr int kDot = 3;           // px a dot of a letter
constexpr int kLabel = 5 * kDot + 2 * kGap;
constexpr int kTiles = 3;       // best, worst, sphere
constexpr int kMethodRows = 9;  // methods below each other
constexpr Rgb8 kWhite{255, 255, 255};

/// Letters of 3 × 5 dots: an octal digit a row, from the top, its highest bit on the left.
std::uint32_t letter(char c) {
  constexpr std::array<std::uint32_t, 26> kLetters{
      025755, 065656, 034443, 065556, 074647, 074644, 034553, 055755, 072227,
      011152, 055655, 044447, 057755, 065555, 025552, 065644, 025563, 065655,
      034216, 072222, 055557, 055552, 055775, 055255, 055222, 071247};
  constexpr std::array<std::uint32_t, 10> kDigits{075557, 026227, 061247, 061216, 055711,
                                                  074616, 034757, 071222, 075757, 075716};
  constexpr std::uint32_t kDash = 000700;
  const auto byte = static_cast<unsigned char>(c);
  if (std::isdigit(byte) != 0) {
    return kDigits[static_cast<std::size_t>(c - '0')];
  }
  if (std::isalpha(byte) != 0) {
    return kLetters[static_cast<std::size_t>(std::tolower(byte) - 'a')];
  }
  return c == '-' ? kDash : 0;
}

/// A white picture that others are put on.
class Sheet {
 public:
  Sheet(int width, int height) {
    image_.width = width;
    image_.height = height;
    image_.rgba.assign(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 255);
  }

  void place(const Image& tile, int left, int top) {
    for (int y = 0; y < tile.height; ++y) {
      std::copy_n(tile.pixel(0, y), 4 * static_cast<std::size_t>(tile.width), at(left, top + y));
    }
  }

  void write(std::string_view text, int left, int top) {
    for (const char c : text) {
      const std::uint32_t dots = letter(c);
      for (int y = 0; y < 5 * kDot; ++y) {
        for (int x = 0; x < 3 * kDot; ++x) {
          const int bit = 3 * (4 - y / kDot) + 2 - x / kDot;
          if ((dots >> static_cast<unsigned>(bit) & 1U) != 0 && left + x < image_.width) {
            std::fill_n(at(left + x, top + y), 3, std::uint8_t{40});
          }
        }
      }
      left += 4 * kDot;
    }
  }

  Image take() { return std::move(image_); }

 private:
  std::uint8_t* at(int x, int y) {
    return image_.rgba.data() + (image_.pixel(x, y) - image_.rgba.data());
  }

  Image image_{};
};

/// The sphere of views, coloured by how good they are.
Image sphere_picture(const Comparison& comparison, const ComparedMethod& method, UpAxis up,
                     const RunContext& run) {
  TriMesh sphere{comparison.set.directions, comparison.set.triangles};
  std::vector<double> good = method.values;
  if (method.measure.better == Better::Less) {
    for (double& value : good) {
      value = -value;
    }
  }
  constexpr double kDistance = 4.0;
  const UprightFrame frame = upright_frame(up_vector(up));
  const Vec3 eye = kDistance * (0.5 * frame.side + 0.4 * frame.up + frame.front).normalized();
  const Camera camera = frame_points(sphere.positions, {Projection::Perspective, eye}, Vec3::Zero(),
                                     up_vector(up), static_cast<double>(kTileWidth) / kTileHeight);
  RenderOptions look;
  look.width = kTileWidth;
  look.height = kTileHeight;
  look.background = kWhite;
  return render(sphere, camera, colour_map(good), {}, look, run);
}

}  // namespace

Image comparison_sheet(const ShapeAnalysis& shape, const Comparison& comparison, UpAxis up,
                       const ViewOptions& options, const RunContext& run) {
  const int count = static_cast<int>(comparison.methods.size());
  const int rows = std::min(count, kMethodRows);
  const int columns = (count + kMethodRows - 1) / kMethodRows;
  const int block_width = kTiles * (kTileWidth + kGap) + 2 * kGap;
  const int block_height = kLabel + kTileHeight + kGap;
  Sheet sheet(columns * block_width, rows * block_height + kGap);
  RunContext quiet = run;
  quiet.report = nullptr;
  ViewOptions small = options;
  small.width = kTileWidth;
  small.height = kTileHeight;
  const ScoringCamera camera = scoring_camera(shape, options);
  const std::vector<Vec3> points = referenced_points(shape.surface);
  const auto picture = [&](const MeasuredView& view) {
    const Camera framed =
        frame_points(points, camera.viewpoint(view.direction), camera.sphere.centre, up_vector(up),
                     static_cast<double>(kTileWidth) / kTileHeight);
    return take_picture(shape, framed, Picture::Plain, small, kWhite, quiet);
  };
  for (int m = 0; m < count; ++m) {
    run.advance("pictures", static_cast<double>(m) / count);
    const ComparedMethod& method = comparison.methods[static_cast<std::size_t>(m)];
    const int left = m / kMethodRows * block_width + kGap;
    const int top = m % kMethodRows * block_height + kGap;
    sheet.write(method.measure.name + (m % kMethodRows == 0 ? "  best  worst  all views" : ""),
                left, top);
    const std::array<Image, kTiles> tiles{picture(method.views.best), picture(method.views.worst),
                                          sphere_picture(comparison, method, up, quiet)};
    for (int t = 0; t < kTiles; ++t) {
      sheet.place(tiles[static_cast<std::size_t>(t)], left + t * (kTileWidth + kGap),
                  top + kLabel - kGap);
    }
  }
  return sheet.take();
}

}  // namespace vantage
