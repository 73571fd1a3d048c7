// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vantage/core/image.h"

/// \file
/// Pictures in a terminal.

namespace vantage::cli {

/// How a terminal is told to show a picture.
enum class PictureProtocol {
  Blocks,  ///< Two pixels a character, as colours of half blocks; any terminal.
  Kitty,   ///< kitty's graphics protocol: kitty, Ghostty, Konsole, WezTerm.
  Iterm,   ///< iTerm2's inline images: iTerm2, WezTerm, mintty.
  Sixel,   ///< DEC sixel graphics: foot, mlterm, xterm -ti vt340, …
};

/// Size of a terminal in characters.
struct TerminalSize {
  int columns = 80;
  int rows = 24;
};

/// The best protocol that the terminal on standard output claims to know: by its environment, else
/// by its answer to the question for its attributes. Blocks if it is no terminal.
PictureProtocol terminal_protocol();

/// Of the terminal on standard output, or 80 × 24.
TerminalSize terminal_size();

/// Side of the picture to draw for a protocol, px: width and height in the given proportion, so that
/// it fits the terminal with room for a summary.
struct PictureExtent {
  int width = 0;
  int height = 0;
};

PictureExtent picture_extent(PictureProtocol protocol, const TerminalSize& terminal, double aspect);

/// The characters that show the picture, a newline at the end.
std::string terminal_picture(const Image& image, PictureProtocol protocol);

}  // namespace vantage::cli
