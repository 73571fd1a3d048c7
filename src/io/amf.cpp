// SPDX-License-Identifier: MIT
#include "io/amf.h"

#include <algorithm>
#include <string>

#include "io/amf_document.h"
#include "io/model_builder.h"
#include "io/plate.h"
#include "io/readers.h"
#include "io/text_cursor.h"
#include "io/threemf_package.h"
#include "io/xml_reader.h"

namespace vantage {
namespace {

constexpr std::size_t kAmfPiece = std::size_t{1} << 16U;

/// Hands the text over, that of an archive's first AMF if it is packed.
void read_text(std::string_view bytes, AmfDocument& document, const ModelBuilder& builder) {
  const auto add = [&](std::string_view piece) {
    builder.run().check();
    document.add(piece);
  };
  if (!bytes.starts_with("PK")) {
    for (; !bytes.empty(); bytes.remove_prefix(std::min(kAmfPiece, bytes.size()))) {
      add(bytes.substr(0, kAmfPiece));
    }
    return;
  }
  bool is_found = false;
  const PartSink sink{[&](const std::string& name) {
                        const bool is_first = !is_found && name.ends_with(".amf");
                        is_found = is_found || is_first;
                        return is_first;
                      },
                      add, [] {}};
  read_package(bytes, sink, builder);
  if (!is_found) {
    builder.fail("the archive holds no file that is named .amf");
  }
}

}  // namespace

bool is_amf(std::string_view bytes) {
  constexpr std::size_t kTellingBytes = 8192;
  std::string_view rest = xml_trimmed(without_bom(bytes.substr(0, kTellingBytes)));
  while (rest.starts_with("<?") || rest.starts_with("<!")) {
    const bool has_declarations =
        rest.substr(0, rest.find('>')).find('[') != std::string_view::npos;
    const std::string_view close = rest.starts_with("<!--") ? "-->" : has_declarations ? "]>" : ">";
    const std::size_t at = rest.find(close);
    rest = at == std::string_view::npos ? "" : xml_trimmed(rest.substr(at + close.size()));
  }
  constexpr std::string_view kRoot = "<amf";
  return rest.starts_with(kRoot) && rest.size() > kRoot.size() &&
         std::string_view(" \t\r\n>/").find(rest[kRoot.size()]) != std::string_view::npos;
}

Model parse_amf(std::string_view bytes, std::string_view name, const RunContext& run,
                const Surroundings& surroundings) {
  ModelBuilder builder(ModelFormat::Amf, name, run, 0);
  if (surroundings.options.appearance) {
    builder.keep_appearance(/*of_vertices=*/false);
  }
  std::size_t records_left = kMostRecordsOfSmallFile + bytes.size();
  AmfDocument document(builder, records_left);
  read_text(bytes, document, builder);
  const PlateParts parts{{"", document.finish()}};
  const PlatePart& part = parts.begin()->second;
  if (part.needs_double) {
    builder.coordinates_need_double();
  }
  if (part.has_unread_materials && builder.keeps_appearance()) {
    builder.note("textures, and colours that are formulas, left out; other colours are read");
  }
  if (document.has_curves()) {
    builder.note("edges and normals left out, by which triangles would be curved");
  }
  if (document.has_sized_instances()) {
    builder.note("scales and mirrors of instances left out, which AMF does not have");
  }
  builder.limit_faces(surroundings.options.max_faces);
  PlateReader reader(parts, bytes.size(), builder);
  if (!part.objects.empty()) {
    reader.read("");
  }
  if (!reader.shows_triangles()) {
    builder.fail("holds no triangles");
  }
  if (builder.keeps_appearance()) {
    builder.set_materials(reader.materials(), {});
  }
  return builder.finish();
}

}  // namespace vantage
