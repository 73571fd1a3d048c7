// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vantage {

/// A file beside a model that the model's reader opens.
struct FileBeside {
  std::string name{};  ///< Relative to the model's folder, as the reader understands the model.
  std::string path{};  ///< Where it is, links resolved: in the model's folder, or below.
};

/// Finds the files that a model consists of besides its own, while its bytes pass by: buffers and
/// pictures of a glTF, material libraries of an OBJ and the pictures that these name. They are found
/// as load_model() finds them.
class FilesBeside {
 public:
  /// \param model_path of the model, whose extension says what it is.
  explicit FilesBeside(std::string model_path);

  /// The model's next bytes.
  void pass(std::string_view bytes);

  /// Call once all bytes have passed. \return the files that are there, each once, in an order that
  /// the files' contents say. Those of a glTF of more than 64 MB of JSON are not found.
  [[nodiscard]] std::vector<FileBeside> find() const;

 private:
  void keep_libraries(std::string_view bytes);

  std::string model_path_;
  bool is_obj_ = false;
  bool is_gltf_ = false;
  std::string text_{};    ///< The glTF, or the lines of an OBJ that name libraries.
  std::string line_{};    ///< Of an OBJ: what has passed of the current line, as far as it matters.
  bool skips_ = false;    ///< The rest of the line does not matter.
  bool goes_on_ = false;  ///< The line before ends with \, so this one belongs to it.
};

}  // namespace vantage
