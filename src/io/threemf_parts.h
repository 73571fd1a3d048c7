// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "io/model_builder.h"
#include "io/plate.h"

namespace vantage {

/// Reads a part of the type 3D model, piece by piece. A document type, and with it every entity, is
/// refused.
class ThreemfPartReader {
 public:
  /// \param name of the part, for messages. \param records_left objects, uses of them and colours that
  /// may still be read; counts down. All must outlive this.
  ThreemfPartReader(const std::string& name, const ModelBuilder& builder,
                    std::size_t& records_left);
  ~ThreemfPartReader();
  ThreemfPartReader(const ThreemfPartReader&) = delete;
  ThreemfPartReader& operator=(const ThreemfPartReader&) = delete;

  /// \throw FormatError
  void add(std::string_view piece);
  PlatePart finish();

 private:
  class State;
  std::unique_ptr<State> state_;
};

/// The part that is the model, by the package's relationships ("_rels/.rels"); empty if they do not
/// say.
std::string threemf_root(std::string_view relationships);

}  // namespace vantage
