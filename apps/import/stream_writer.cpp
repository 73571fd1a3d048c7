// SPDX-License-Identifier: MIT
#include "stream_writer.h"

#include <algorithm>
#include <cerrno>
#include <stdexcept>

#include <unistd.h>

namespace vantage::importing {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 18U;  // bytes sent at a time [ours]

template <class T>
std::uint64_t bytes_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

}  // namespace

std::uint64_t StreamMesh::triangle_count() const {
  std::uint64_t count = 0;
  for (std::size_t at = 0; at < faces.size(); at += faces[at] + std::size_t{1}) {
    count += std::max(faces[at], 2U) - 2U;
  }
  return count;
}

void StreamWriter::flush() {
  std::string_view rest = waiting_;
  while (!rest.empty()) {
    const ssize_t sent = ::write(descriptor_, rest.data(), rest.size());
    if (sent < 0 && errno != EINTR) {
      throw std::runtime_error("nobody listens");
    }
    rest.remove_prefix(sent > 0 ? static_cast<std::size_t>(sent) : 0);
  }
  waiting_.clear();
}

void StreamWriter::put(std::string_view bytes) {
  waiting_.append(bytes);
  if (waiting_.size() >= kBlock) {
    flush();
  }
}

void StreamWriter::record(std::string_view tag, std::uint64_t size) {
  put(tag);
  number(size);
}

void StreamWriter::head(const StreamHead& head) {
  record("head", sizeof(double) + 3 * sizeof(std::uint32_t));
  number(head.unit_m);
  number(head.up);
  number(std::uint32_t{head.up_is_stated});
  number(std::uint32_t{head.double_precision});
}

void StreamWriter::note(std::string_view text) {
  record("note", text.size());
  put(text);
}

void StreamWriter::picture(bool inside, std::string_view content) {
  record("pict", sizeof(std::uint32_t) + content.size());
  number(std::uint32_t{inside});
  put(content);
}

void StreamWriter::material(const StreamMaterial& material) {
  record("matl", 4 * sizeof(double) + 3 * sizeof(std::uint32_t));
  for (const double channel : material.colour) {
    number(channel);
  }
  number(material.picture);
  number(material.wrap_u);
  number(material.wrap_v);
}

void StreamWriter::count(const StreamMesh& mesh) {
  faces_ += mesh.triangle_count();
  points_ += mesh.positions.size() / 3;
  if (most_faces_ > 0 && (faces_ > most_faces_ || points_ / 3 > most_faces_)) {
    throw TooMany{faces_ <= most_faces_};
  }
}

void StreamWriter::mesh(const StreamMesh& mesh) {
  count(mesh);
  record("mesh", 3 * sizeof(std::uint32_t) + mesh.name.size() + 2 * sizeof(std::uint64_t) +
                     bytes_of(mesh.positions) + bytes_of(mesh.colours) + bytes_of(mesh.places) +
                     bytes_of(mesh.faces));
  number((mesh.colours.empty() ? 0U : kImportColours) | (mesh.places.empty() ? 0U : kImportPlaces) |
         (mesh.same_part ? kImportSamePart : 0U));
  number(mesh.material);
  number(static_cast<std::uint32_t>(mesh.name.size()));
  put(mesh.name);
  number(std::uint64_t{mesh.positions.size() / 3});
  number(mesh.face_count);
  numbers(mesh.positions);
  numbers(mesh.colours);
  numbers(mesh.places);
  numbers(mesh.faces);
  ++meshes_;
}

void StreamWriter::fail(std::string_view text) {
  record("fail", text.size());
  put(text);
  flush();
}

void StreamWriter::fail(TooMany problem) {
  record("many", sizeof(std::uint32_t));
  number(std::uint32_t{problem.points});
  flush();
}

void StreamWriter::done() {
  record("done", sizeof(std::uint64_t));
  number(meshes_);
  flush();
}

}  // namespace vantage::importing
