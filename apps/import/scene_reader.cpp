// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <new>
#include <stdexcept>
#include <string_view>

#include <assimp/GltfMaterial.h>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <assimp/version.h>

#include "readers.h"
#include "scene_meshes.h"

namespace vantage::importing {
namespace {

/// There are no other files: what a scene names beside itself is read by the program that asked.
class NoFiles : public Assimp::IOSystem {
 public:
  bool Exists(const char* /*file*/) const override { return false; }

  char getOsSeparator() const override { return '/'; }

  Assimp::IOStream* Open(const char* /*file*/, const char* /*mode*/) override { return nullptr; }

  void Close(Assimp::IOStream* /*file*/) override {}
};

/// Leaves the one reader of an extension, so that a file is never taken for something else.
void keep_only(Assimp::Importer& importer, const std::string& extension) {
  Assimp::BaseImporter* const wanted = importer.GetImporter(extension.c_str());
  if (wanted == nullptr) {
    throw std::runtime_error("this build of Assimp has no reader for it");
  }
  for (std::size_t i = importer.GetImporterCount(); i > 0; --i) {
    if (Assimp::BaseImporter* const other = importer.GetImporter(i - 1); other != wanted) {
      importer.UnregisterLoader(other);
    }
  }
}

void configure(Assimp::Importer& importer) {
  // One node a model instead of a chain for each pivot.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_CAMERAS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_LIGHTS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_MD5_NO_ANIM_AUTOLOAD, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_MD3_HANDLE_MULTIPART, false);
  // Bones without a surface are not dressed up as one.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
}

/// Linear light of an sRGB value (IEC 61966-2-1).
double linear(double value) {
  constexpr double kKnee = 0.04045;
  const double v = std::clamp(std::isfinite(value) ? value : 1.0, 0.0, 1.0);
  return v <= kKnee ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

std::uint32_t wrap_of(const aiMaterial& material, aiTextureType type, bool along_u) {
  int mode = aiTextureMapMode_Wrap;
  if (along_u) {
    material.Get(AI_MATKEY_MAPPINGMODE_U(type, 0), mode);
  } else {
    material.Get(AI_MATKEY_MAPPINGMODE_V(type, 0), mode);
  }
  return mode == aiTextureMapMode_Mirror ? 1U : mode == aiTextureMapMode_Clamp ? 2U : 0U;
}

/// Sends materials and the pictures that they name, each picture once.
class MaterialSender {
 public:
  MaterialSender(const aiScene& scene, StreamWriter& out) : scene_(scene), out_(out) {}

  void send() {
    for (unsigned m = 0; m < scene_.mNumMaterials; ++m) {
      out_.material(material(*scene_.mMaterials[m]));
    }
    if (raw_pictures_ > 0) {
      out_.note("pictures that the file holds as bare texels were left out: " +
                std::to_string(raw_pictures_));
    }
  }

 private:
  StreamMaterial material(const aiMaterial& source) {
    StreamMaterial result;
    aiColor4D colour(1.0F, 1.0F, 1.0F, 1.0F);
    if (source.Get(AI_MATKEY_BASE_COLOR, colour) != aiReturn_SUCCESS) {
      source.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
    }
    float opacity = 1.0F;
    source.Get(AI_MATKEY_OPACITY, opacity);
    const aiTextureType type = source.GetTextureCount(aiTextureType_BASE_COLOR) > 0
                                   ? aiTextureType_BASE_COLOR
                                   : aiTextureType_DIFFUSE;
    aiString path;
    if (source.GetTexture(type, 0, &path) == aiReturn_SUCCESS && path.length > 0) {
      result.picture = picture(path);
      result.wrap_u = wrap_of(source, type, true);
      result.wrap_v = wrap_of(source, type, false);
      // Programs that put the whole colour into the picture often leave the colour black.
      if (colour.IsBlack()) {
        colour = aiColor4D(1.0F, 1.0F, 1.0F, 1.0F);
      }
    }
    // What cannot be seen at all is a slip of the program that wrote it, not a wish.
    const bool seen = opacity > 0.0F && opacity <= 1.0F;
    result.colour = {linear(colour.r), linear(colour.g), linear(colour.b),
                     seen ? static_cast<double>(opacity) : 1.0};
    return result;
  }

  std::uint32_t picture(const aiString& path) {
    const std::string name(path.C_Str());
    const auto [known, is_new] = pictures_.try_emplace(name, kImportNone);
    if (!is_new) {
      return known->second;
    }
    const aiTexture* const inside = scene_.GetEmbeddedTexture(path.C_Str());
    if (inside != nullptr && inside->mHeight != 0) {
      ++raw_pictures_;
      return kImportNone;
    }
    if (inside != nullptr) {
      out_.picture(true, {reinterpret_cast<const char*>(inside->pcData), inside->mWidth});
    } else {
      out_.picture(false, name);
    }
    known->second = next_picture_++;
    return known->second;
  }

  const aiScene& scene_;
  StreamWriter& out_;
  std::map<std::string, std::uint32_t> pictures_{};
  std::uint32_t next_picture_ = 0;
  std::size_t raw_pictures_ = 0;
};

/// Formats in which z is up and that Assimp leaves so. Others have y up, or it turns them.
constexpr std::array<std::string_view, 7> kZUp = {"blend", "cob", "scn", "smd",
                                                  "hmp",   "q3o", "q3s"};

/// Whether an OpenGEX file says that y is up; else it is z, by its specification.
bool is_y_up_in_ogex(std::string_view bytes) {
  constexpr std::string_view kKey = "\"up\"";
  const std::size_t key = bytes.find(kKey);
  const std::size_t value =
      key == std::string_view::npos ? key : bytes.find('"', key + kKey.size());
  return value != std::string_view::npos && bytes.substr(value).starts_with("\"y\"");
}

/// FBX and OpenGEX stay as they are and say which axis is up.
StreamHead head_of(const aiScene& scene, std::string_view extension, std::string_view bytes) {
  StreamHead head;
  head.up = std::find(kZUp.begin(), kZUp.end(), extension) == kZUp.end() ? 1 : 2;
  if (extension == "blend") {  // Blender knows no other up
    head.up_is_stated = true;
  } else if (extension == "ogex") {
    head.up = is_y_up_in_ogex(bytes) ? 1 : 2;
    head.up_is_stated = true;
  } else if (extension == "dae") {
    head.unit_m = 1.0;
    head.up_is_stated = bytes.find("<up_axis>") != std::string_view::npos;
  } else if (extension == "ifc") {
    head.unit_m = 1.0;
    head.up_is_stated = true;
  } else if (extension == "fbx" && scene.mMetaData != nullptr) {
    std::int32_t axis = 1;
    std::int32_t sign = 1;
    float centimetres = 0.0F;
    head.up_is_stated = scene.mMetaData->Get("UpAxis", axis) && axis >= 0 && axis <= 2;
    scene.mMetaData->Get("UpAxisSign", sign);
    head.up = head.up_is_stated ? static_cast<std::uint32_t>(axis + (sign < 0 ? 3 : 0)) : 1;
    double exact = 0.0;
    if (scene.mMetaData->Get("UnitScaleFactor", exact)) {
      head.unit_m = exact / 100.0;
    } else if (scene.mMetaData->Get("UnitScaleFactor", centimetres)) {
      head.unit_m = static_cast<double>(centimetres) / 100.0;
    }
  }
  return head;
}

}  // namespace

void read_scene(std::string_view extension, std::string_view bytes, StreamWriter& out) {
  Assimp::Importer importer;
  const std::string hint(extension);
  keep_only(importer, hint);
  configure(importer);
  importer.SetIOHandler(new NoFiles);  // the importer owns it
  // No step afterwards: each would join, reorder or drop vertices.
  const aiScene* const scene =
      importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, hint.c_str());
  if (scene == nullptr || scene->mRootNode == nullptr) {
    const std::string reason = importer.GetErrorString();
    if (reason.find("bad_alloc") != std::string::npos) {
      throw std::bad_alloc();
    }
    throw std::runtime_error(reason);
  }
  out.head(head_of(*scene, extension, bytes));
  MaterialSender(*scene, out).send();
  send_meshes(*scene, out);
}

std::string scene_library() {
  return "Assimp " + std::to_string(aiGetVersionMajor()) + "." +
         std::to_string(aiGetVersionMinor()) + "." + std::to_string(aiGetVersionPatch());
}

}  // namespace vantage::importing
