// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/run_context.h"

/// \file
/// Formats that the library does not read itself, and the stream of bytes by which a program of its own
/// hands over what it read of one. The program runs the readers of others on files of strangers, so
/// nothing in a stream is trusted: every count is held against the bytes that really came.
///
/// A stream is `kImportMagic` and then records: a tag of four letters, the size of what follows (u64),
/// and so many bytes. Numbers are little-endian, texts UTF-8 without an end mark.
///
///     head  unit: f64, metres of one unit, 0 if unknown; up: u32, 0 to 5 for x y z -x -y -z, 6 if unknown;
///           u32, 1 if the file itself says so; u32, 1 if coordinates need more digits than float holds
///     note  text: what was read in an unusual way
///     pict  u32: 0 beside the model, 1 inside it; then the path below its folder, or the file's bytes
///     matl  f64 red, green, blue (linear), opacity; u32 picture (0 the first, kImportNone for none);
///           u32 wrap in u, in v: 0 repeat, 1 mirror, 2 clamp
///     mesh  u32 flags (a sum of kImportColours and the like); u32 material or kImportNone;
///           u32 size of the name, the name; u64 vertices, u64 faces; 3 f64 a vertex; if flagged 3 f32 a vertex, its colour (sRGB, 0 to 1);
///           if flagged 2 f32 a vertex, its place on pictures from the bottom left corner; and for each face
///           u32 corners and as many u32, vertices of this mesh from 0
///     many  u32: 0 faces, 1 points; there are more than were allowed; the last record
///     fail  text: why nothing can be read; the last record
///     done  u64 meshes that were sent; the last record
///
/// Materials and pictures are numbered in the order of their records.

namespace vantage {

/// A format that is read by way of a stream.
struct ImportFormat {
  std::string_view extension;  ///< Lower case, without the dot.
  std::string_view name;       ///< In results: "step" for .stp too.
  std::string_view title;      ///< For people.
  bool solid;                  ///< Exact surfaces, to be tessellated.
};

/// What to do with a file of the format where it cannot be read, in a sentence.
constexpr std::string_view import_advice(const ImportFormat& format) {
  return format.name == "blend" ? "export it as GLB from Blender"
         : format.solid
             ? "convert it to STL or OBJ first, for example with FreeCAD or gmsh"
             : "convert it to OBJ, PLY or GLB first, for example with meshlab or Blender";
}

/// All of them. What the library reads itself is not among them, nor are scenes that only name other
/// files, which the program may not open.
inline constexpr std::array<ImportFormat, 41> kImportFormats = {{
    {"step", "step", "STEP", true},
    {"stp", "step", "STEP", true},
    {"p21", "step", "STEP", true},
    {"iges", "iges", "IGES", true},
    {"igs", "iges", "IGES", true},
    {"brep", "brep", "BREP", true},
    {"fbx", "fbx", "FBX", false},
    {"dae", "dae", "COLLADA", false},
    {"3ds", "3ds", "3DS", false},
    {"x", "x", "DirectX X", false},
    {"blend", "blend", "Blender", false},
    {"lwo", "lwo", "LightWave", false},
    {"lxo", "lxo", "Modo", false},
    {"ac", "ac", "AC3D", false},
    {"ac3d", "ac", "AC3D", false},
    {"ms3d", "ms3d", "MilkShape", false},
    {"md2", "md2", "Quake II", false},
    {"md3", "md3", "Quake III", false},
    {"md5mesh", "md5mesh", "Doom 3", false},
    {"mdc", "mdc", "Wolfenstein", false},
    {"mdl", "mdl", "Quake or Half-Life", false},
    {"hmp", "hmp", "GameStudio terrain", false},
    {"iqm", "iqm", "Inter-Quake", false},
    {"b3d", "b3d", "Blitz3D", false},
    {"ase", "ase", "3ds Max ASCII", false},
    {"cob", "cob", "trueSpace", false},
    {"scn", "cob", "trueSpace", false},
    {"nff", "nff", "NFF", false},
    {"enff", "nff", "NFF", false},
    {"smd", "smd", "Valve SMD", false},
    {"xgl", "xgl", "XGL", false},
    {"zgl", "xgl", "XGL", false},
    {"irrmesh", "irrmesh", "Irrlicht", false},
    {"q3o", "q3o", "Quick3D", false},
    {"q3s", "q3o", "Quick3D", false},
    {"dxf", "dxf", "DXF", false},
    {"ifc", "ifc", "IFC", false},
    {"x3d", "x3d", "X3D", false},
    {"ogex", "ogex", "OpenGEX", false},
    {"sib", "sib", "Silo", false},
    {"pmx", "pmx", "MikuMikuDance", false},
}};

/// The format of an extension (lower case, without the dot); null if it is none of these.
constexpr const ImportFormat* import_format(std::string_view extension) {
  const auto* const found =
      std::find_if(kImportFormats.begin(), kImportFormats.end(),
                   [&](const ImportFormat& format) { return format.extension == extension; });
  return found == kImportFormats.end() ? nullptr : found;
}

inline constexpr std::string_view kImportMagic = "VNTGIMP1";
inline constexpr std::size_t kImportTagSize = 4;
inline constexpr std::uint32_t kImportNone = 0xFFFFFFFFU;
inline constexpr std::uint32_t kImportNoUp = 6;

// What a `mesh` record has, as a sum.
inline constexpr std::uint32_t kImportColours = 1;   ///< A colour for each vertex.
inline constexpr std::uint32_t kImportPlaces = 2;    ///< A place on pictures for each vertex.
inline constexpr std::uint32_t kImportSamePart = 4;  ///< Belongs to the part of the mesh before.
inline constexpr std::uint32_t kImportKnownFlags = 7;

/// A file to be read elsewhere.
struct ImportRequest {
  const ImportFormat& format;
  std::string_view bytes;  ///< The whole file.
  std::string_view name;   ///< Shown in messages.
};

/// Gives the stream of a file. \throw FormatError, IoError, Cancelled
using ModelImporter =
    std::function<std::string(const ImportRequest& request, const RunContext& run)>;

/// Paths of the pictures that a stream says are beside the model, as its reader understands them; of a stream
/// that is none of ours those up to where it is not.
std::vector<std::string> pictures_beside(std::string_view stream);

}  // namespace vantage
