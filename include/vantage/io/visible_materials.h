// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/mesh/appearance.h"

/// \file
/// Materials that say that nothing at all is to be seen are mistakes: older MeshLab wrote `Tr 1.0` for
/// what is opaque.

namespace vantage {

/// The note of a model whose materials were made opaque.
inline constexpr const char* kMadeOpaque =
    "by its materials no face can be seen at all; it is shown as opaque";

/// Makes all materials opaque if every face is invisible by its own. \return whether it did.
/// \pre indices and textures fit each other.
/// \complexity linear in the faces before the first visible one.
bool make_visible(Appearance& appearance);

}  // namespace vantage
