// SPDX-License-Identifier: MIT
// A 3MF that is put together from objects, components and items of several parts, which show each other,
// themselves, or what is not there: the same model stored and deflated, faces that are counted before
// they are made, or a FormatError.
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "vantage/io/model.h"

#include "choices.h"
#include "io/readers.h"
#include "sound_model.h"
#include "unit/io/zip_archive.h"

namespace {

class ThreemfDraft {
 public:
  explicit ThreemfDraft(Choices& choices) : choices_(choices) {}

  /// Each file of the package.
  std::map<std::string, std::string> files() {
    std::map<std::string, std::string> files;
    if (!choices_.once_in(16)) {
      files["_rels/.rels"] = std::string("<Relationships><Relationship Target=\"/") +
                             choices_.of(kParts) + "\" Type=\"x/3dmodel\"/></Relationships>";
    }
    files[kParts[0]] = part();
    for (std::size_t p = 1; p < kParts.size(); ++p) {
      if (choices_.below(3) == 1) {
        files[kParts[p]] = part();
      }
    }
    return files;
  }

 private:
  static constexpr std::array<const char*, 3> kParts{"3D/3dmodel.model", "3D/a.model",
                                                     "3D/B.MODEL"};
  static constexpr std::size_t kMostObjects = 6;

  std::string part() {
    constexpr std::array<const char*, 4> kUnits{"", " unit=\"inch\"", " unit=\"\"",
                                                " xml:lang=\"en\" unit=\"micron\""};
    std::string text = std::string("<model") + choices_.of(kUnits) + "><resources>";
    for (std::size_t group = choices_.below(3); group > 0; --group) {
      text += colours(group);
    }
    const std::size_t objects = 1 + choices_.below(kMostObjects);
    for (std::size_t id = 1; id <= objects; ++id) {
      text += object(choices_.once_in(64) ? choices_.index(kMostObjects) : std::to_string(id), id);
    }
    text += "</resources><build>";
    for (std::size_t i = choices_.below(4); i > 0; --i) {
      text += "<item" + use(objects + 1) + "/>";
    }
    return text + "</build></model>";
  }

  std::string colours(std::size_t id) {
    const bool is_base = choices_.below(2) == 0;
    constexpr std::array<const char*, 5> kColours{"#FF8000", "#ff800080", "#GG0000", "", "red"};
    std::string text = std::string(is_base ? "<basematerials" : "<colorgroup") + " id=\"" +
                       std::to_string(100 + id) + "\">";
    for (std::size_t i = choices_.below(3); i > 0; --i) {
      text += std::string(is_base ? "<base displaycolor=\"" : "<color color=\"") +
              choices_.of(kColours) + "\"/>";
    }
    return text + (is_base ? "</basematerials>" : "</colorgroup>");
  }

  std::string object(const std::string& id, std::size_t place) {
    constexpr std::array<const char*, 5> kTypes{"", " type=\"model\"", " type=\"support\"",
                                                " type=\"surface\"", " type=\"?\""};
    std::string text = "<object id=\"" + id + "\"" + choices_.of(kTypes) + colour("pindex") +
                       (choices_.once_in(4) ? " name=\"o&amp;o\"" : "") + ">";
    if (choices_.below(2) == 0) {
      return text + mesh() + "</object>";
    }
    text += "<components>";
    for (std::size_t i = choices_.below(4); i > 0; --i) {
      text += "<component" + use(place) + "/>";  // of an earlier object, mostly
    }
    return text + "</components></object>";
  }

  std::string colour(const char* name) {
    return choices_.once_in(4) ? " pid=\"" + std::to_string(101 + choices_.below(3)) + "\" " +
                                     name + "=\"" + choices_.index(3) + "\""
                               : "";
  }

  std::string mesh() {
    const std::size_t points = 3 + choices_.below(4);
    std::string text = "<mesh><vertices>";
    for (std::size_t i = 0; i < points; ++i) {
      text += "<vertex x=\"" + choices_.number() + "\" y=\"" + choices_.number() + "\" z=\"" +
              choices_.number() + "\"/>";
    }
    text += "</vertices><triangles>";
    for (std::size_t i = 1 + choices_.below(4); i > 0; --i) {
      text += "<triangle";
      for (const char* const corner : {" v1=\"", " v2=\"", " v3=\""}) {
        text += corner +
                (choices_.once_in(64) ? choices_.index(points)
                                      : std::to_string(choices_.below(points))) +
                "\"";
      }
      text += colour("p1") + "/>";
    }
    return text + "</triangles></mesh>";
  }

  /// What an item or a component says: an object from 1 to `end` − 1, its part, how it is moved.
  std::string use(std::size_t end) {
    const bool is_known = end > 1 && !choices_.once_in(64);
    std::string text =
        " objectid=\"" +
        (is_known ? std::to_string(1 + choices_.below(end - 1)) : choices_.index(8)) + "\"";
    if (choices_.once_in(6)) {
      text += std::string(" path=\"/") + choices_.of(kParts) + "\"";
    }
    if (choices_.once_in(3)) {
      text += " transform=\"";
      for (std::size_t i = choices_.once_in(64) ? 11 : 12; i > 0; --i) {
        text += choices_.number() + " ";
      }
      text += "\"";
    }
    return text;
  }

  Choices& choices_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Choices choices(data, size);
  const std::map<std::string, std::string> files = ThreemfDraft(choices).files();
  const auto read = [&](bool is_packed, std::size_t most_faces) {
    const vantage::ReadOptions options{.appearance = true, .max_faces = most_faces};
    const std::string bytes =
        vantage::test::zip_archive({files.begin(), files.end()},
                                   is_packed ? "zip:compression=deflate" : "zip:compression=store");
    return vantage::parse_threemf(bytes, "fuzz.3mf", {}, {{}, {}, options});
  };
  const auto model = sound_model([&] { return read(false, 0); });
  expect_same(model, sound_model([&] { return read(true, 0); }));
  if (model) {
    expect_limit(*model, [&](std::size_t most) { return read(false, most); });
  }
  return 0;
}
