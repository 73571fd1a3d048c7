// SPDX-License-Identifier: MIT
#include "vantage/io/import_stream.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "vantage/core/error.h"

#include "io/byte_cursor.h"
#include "io/model_builder.h"
#include "io/named_path.h"
#include "io/readers.h"
#include "io/texture_loader.h"

namespace vantage {
namespace {

/// Most notes that are kept; what else a reader says is counted. [ours]
constexpr std::size_t kMostNotes = 20;
constexpr std::size_t kLongestNote = 500;  ///< Bytes. [ours]

/// Takes numbers and texts off a record, never more than it has.
class RecordCursor {
 public:
  RecordCursor(std::string_view bytes, const ModelBuilder& builder)
      : bytes_(bytes), builder_(builder) {}

  template <class T>
  T number() {
    return decode<T>(take(sizeof(T)).data(), ByteOrder::Little);
  }

  std::string_view take(std::uint64_t size) {
    if (size > bytes_.size()) {
      builder_.fail("vantage-import sent less than it announced");
    }
    const std::string_view taken = bytes_.substr(0, static_cast<std::size_t>(size));
    bytes_.remove_prefix(taken.size());
    return taken;
  }

  /// `count` items of `size` bytes each.
  std::string_view take_items(std::uint64_t count, std::size_t size) {
    return take(count > bytes_.size() / size ? bytes_.size() + std::uint64_t{1} : count * size);
  }

  std::string_view rest() { return take(bytes_.size()); }

  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
  const ModelBuilder& builder_;
};

/// Text of another program for a sentence of ours: short, one line, no control characters.
std::string one_line(std::string_view text) {
  std::string line(text.substr(0, kLongestNote));
  for (char& c : line) {
    c = static_cast<unsigned char>(c) < ' ' || c == '\x7F' ? ' ' : c;
  }
  while (!line.empty() && (line.back() == ' ' || line.back() == '.')) {
    line.pop_back();
  }
  return line;
}

/// A picture's path as the importer sends it.
std::string named_picture(std::string_view path) {
  const std::string named = with_slashes(path);
  return named.starts_with("./") ? named.substr(2) : named;
}

double share(double value, double otherwise) {
  return std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : otherwise;
}

class StreamReader {
 public:
  StreamReader(std::string_view stream, const ImportFormat& format, std::string_view name,
               const RunContext& run, const Surroundings& surroundings)
      : builder_(ModelFormat::Imported, name, run, 0),
        all_(stream),
        format_(format),
        wants_appearance_(surroundings.options.appearance),
        loader_(surroundings, builder_),
        textures_(loader_),
        surroundings_(surroundings) {
    if (wants_appearance_) {
      builder_.keep_appearance(/*of_vertices=*/true);
    }
  }

  Model read() {
    RecordCursor cursor(all_, builder_);
    if (all_.size() < kImportMagic.size() || cursor.take(kImportMagic.size()) != kImportMagic) {
      builder_.fail("vantage-import is of another version than this program; install both anew");
    }
    while (!done_) {
      if (cursor.left() == 0) {
        builder_.fail("vantage-import stopped in the middle");
      }
      const std::string_view tag = cursor.take(kImportTagSize);
      const auto size = cursor.number<std::uint64_t>();
      RecordCursor record(cursor.take(size), builder_);
      read_record(tag, record);
      if (record.left() != 0) {
        builder_.fail("vantage-import sent more than it announced");
      }
    }
    if (cursor.left() != 0) {
      builder_.fail("vantage-import went on after its end");
    }
    return finish();
  }

 private:
  void read_record(std::string_view tag, RecordCursor& record) {
    if (tag == "head") {
      read_head(record);
    } else if (tag == "note") {
      add_note(record.rest());
    } else if (tag == "pict") {
      const auto kind = record.number<std::uint32_t>();
      pictures_.push_back({kind == 1, record.rest()});
    } else if (tag == "matl") {
      read_material(record);
    } else if (tag == "mesh") {
      read_mesh(record);
    } else if (tag == "many") {
      const bool of_points = record.number<std::uint32_t>() == 1;
      builder_.fail(too_many_faces(surroundings_.options.max_faces, of_points));
    } else if (tag == "fail") {
      fail(one_line(record.rest()));
    } else if (tag == "done") {
      done_ = true;
      if (record.number<std::uint64_t>() != meshes_) {
        builder_.fail("vantage-import lost a part of the model");
      }
    } else {
      builder_.fail("vantage-import is of another version than this program; install both anew");
    }
  }

  [[noreturn]] void fail(const std::string& reason) const {
    // Many files that are whole are not understood: the fault may be the reader's.
    builder_.fail("cannot be read as " + std::string(format_.title) + " by " +
                  (format_.solid ? "Open CASCADE: " : "Assimp: ") + reason + "; " +
                  std::string(import_advice(format_)));
  }

  void read_head(RecordCursor& record) {
    const auto unit = record.number<double>();
    unit_m_ = std::isfinite(unit) && unit > 0.0 ? unit : 0.0;
    const auto up = record.number<std::uint32_t>();
    if (up < kImportNoUp) {
      Vec3 axis = Vec3::Zero();
      axis[static_cast<int>(up % 3)] = up < 3 ? 1.0 : -1.0;
      up_ = axis;
    }
    up_is_stated_ = record.number<std::uint32_t>() == 1 && up_.has_value();
    if (record.number<std::uint32_t>() == 1) {
      builder_.coordinates_need_double();
    }
  }

  void add_note(std::string_view text) {
    if (notes_++ < kMostNotes) {
      builder_.note(one_line(text));
    }
  }

  void read_material(RecordCursor& record) {
    Material material;
    for (double& channel : material.colour) {
      channel = share(record.number<double>(), 1.0);
    }
    material.opacity = share(record.number<double>(), 1.0);
    material.alpha = material.opacity < 1.0 ? AlphaMode::Blend : AlphaMode::Opaque;
    const auto picture = record.number<std::uint32_t>();
    const TextureWrap wrap_u = wrap_of(record.number<std::uint32_t>());
    const TextureWrap wrap_v = wrap_of(record.number<std::uint32_t>());
    if (wants_appearance_ && picture < pictures_.size()) {
      material.texture = textures_.add(picture, {{}, wrap_u, wrap_v, false},
                                       [&] { return image_of(pictures_[picture]); });
    }
    // Places count from the bottom left corner here, and from the top left one in a Material.
    material.uv_transform = {1.0, 0.0, 0.0, 0.0, -1.0, 1.0};
    materials_.push_back(material);
  }

  static TextureWrap wrap_of(std::uint32_t word) {
    return word == 1 ? TextureWrap::Mirror : word == 2 ? TextureWrap::Clamp : TextureWrap::Repeat;
  }

  struct Picture {
    bool inside = false;
    std::string_view content;  ///< The file's bytes, or its path.
  };

  std::optional<Image> image_of(const Picture& picture) {
    if (picture.inside) {
      return loader_.embedded(picture.content, "inside the file");
    }
    const std::optional<std::string> path =
        place_of_picture(named_picture(picture.content), surroundings_.has_side_file);
    return path ? loader_.beside(*path) : std::nullopt;
  }

  void read_mesh(RecordCursor& record) {
    const auto flags = record.number<std::uint32_t>();
    const auto material = record.number<std::uint32_t>();
    const std::string part = one_line(record.take(record.number<std::uint32_t>()));
    const auto vertices = record.number<std::uint64_t>();
    const auto faces = record.number<std::uint64_t>();
    if ((flags & ~kImportKnownFlags) != 0) {
      builder_.fail("vantage-import is of another version than this program; install both anew");
    }
    if ((flags & kImportSamePart) == 0 || meshes_ == 0) {
      builder_.begin_part(part);
    }
    ++meshes_;
    if (wants_appearance_) {
      builder_.begin_material(material < materials_.size() ? material : Appearance::kNone);
    }
    const std::size_t first = builder_.point_count();
    read_vertices(record.take_items(vertices, 3 * sizeof(double)));
    read_colours((flags & kImportColours) != 0 ? record.take_items(vertices, 3 * sizeof(float))
                                               : std::string_view());
    const std::string_view places = (flags & kImportPlaces) != 0
                                        ? record.take_items(vertices, 2 * sizeof(float))
                                        : std::string_view();
    if (wants_appearance_) {
      read_places(places);
    }
    read_faces(record, first, vertices, faces);
  }

  void read_vertices(std::string_view bytes) {
    for (RecordCursor cursor(bytes, builder_); cursor.left() > 0;) {
      const auto x = cursor.number<double>();
      const auto y = cursor.number<double>();
      const auto z = cursor.number<double>();
      builder_.add_point({x, y, z}, {"vertex", builder_.point_count()});
      advance(bytes);
    }
  }

  /// Where one part has colours the others are white.
  void read_colours(std::string_view bytes) {
    if (bytes.empty() && builder_.colour_count() == 0) {
      return;
    }
    const std::size_t here = bytes.size() / (3 * sizeof(float));
    while (builder_.colour_count() + here < builder_.point_count()) {
      builder_.add_colour(1.0, 1.0, 1.0);
    }
    for (RecordCursor cursor(bytes, builder_); cursor.left() > 0;) {
      const double red = share(static_cast<double>(cursor.number<float>()), 1.0);
      const double green = share(static_cast<double>(cursor.number<float>()), 1.0);
      const double blue = share(static_cast<double>(cursor.number<float>()), 1.0);
      builder_.add_colour(red, green, blue);
    }
  }

  void read_places(std::string_view bytes) {
    for (RecordCursor cursor(bytes, builder_); cursor.left() > 0;) {
      const auto u = static_cast<double>(cursor.number<float>());
      const auto v = static_cast<double>(cursor.number<float>());
      builder_.add_uv(u, v);
    }
    while (builder_.uv_count() < builder_.point_count()) {
      builder_.add_uv(0.0, 0.0);
    }
  }

  void read_faces(RecordCursor& record, std::size_t first, std::uint64_t vertices,
                  std::uint64_t faces) {
    for (std::uint64_t f = 0; f < faces; ++f) {
      const auto corners = record.number<std::uint32_t>();
      RecordCursor face(record.take_items(corners, sizeof(std::uint32_t)), builder_);
      for (std::uint32_t c = 0; c < corners; ++c) {
        const auto vertex = face.number<std::uint32_t>();
        if (vertex >= vertices) {
          builder_.fail("a face names vertex " + std::to_string(vertex) + " of a part that has " +
                        std::to_string(vertices));
        }
        builder_.add_corner(first + vertex, {"face", static_cast<std::size_t>(f)});
      }
      builder_.end_polygon();
      has_faces_ = has_faces_ || corners >= 3;
      advance(all_);
    }
  }

  void advance(std::string_view at) {
    builder_.advance(static_cast<std::size_t>(at.data() - all_.data()), all_.size());
  }

  Model finish() {
    if (!has_faces_) {
      builder_.fail("holds no faces");
    }
    if (notes_ > kMostNotes) {
      builder_.note(std::to_string(notes_ - kMostNotes) + " more remarks of the reader left out");
    }
    loader_.finish();
    if (wants_appearance_) {
      builder_.set_materials(std::move(materials_), textures_.take());
    }
    Model model = builder_.finish();
    model.unit_m = unit_m_;
    model.usual_up = up_;
    model.up_is_stated = up_is_stated_;
    return model;
  }

  ModelBuilder builder_;
  std::string_view all_;
  const ImportFormat& format_;
  bool wants_appearance_;
  TextureLoader loader_;
  TextureList textures_;
  const Surroundings& surroundings_;
  std::vector<Picture> pictures_{};
  std::vector<Material> materials_{};
  std::uint64_t meshes_ = 0;
  std::size_t notes_ = 0;
  double unit_m_ = 0.0;
  std::optional<Vec3> up_{};
  bool up_is_stated_ = false;
  bool has_faces_ = false;
  bool done_ = false;
};

}  // namespace

std::vector<std::string> pictures_beside(std::string_view stream) {
  constexpr std::size_t kSizeSize = sizeof(std::uint64_t);
  constexpr std::size_t kKindSize = sizeof(std::uint32_t);
  std::vector<std::string> pictures;
  if (!stream.starts_with(kImportMagic)) {
    return pictures;
  }
  stream.remove_prefix(kImportMagic.size());
  while (stream.size() >= kImportTagSize + kSizeSize) {
    const std::string_view tag = stream.substr(0, kImportTagSize);
    const auto size = decode<std::uint64_t>(stream.data() + kImportTagSize, ByteOrder::Little);
    stream.remove_prefix(kImportTagSize + kSizeSize);
    if (size > stream.size()) {
      break;
    }
    const std::string_view record = stream.substr(0, static_cast<std::size_t>(size));
    stream.remove_prefix(record.size());
    if (tag == "pict" && record.size() > kKindSize &&
        decode<std::uint32_t>(record.data(), ByteOrder::Little) != 1) {
      pictures.push_back(named_picture(record.substr(kKindSize)));
    }
  }
  return pictures;
}

Model parse_import_stream(std::string_view stream, const ImportFormat& format,
                          std::string_view name, const RunContext& run,
                          const Surroundings& surroundings) {
  return StreamReader(stream, format, name, run, surroundings).read();
}

}  // namespace vantage
