// SPDX-License-Identifier: MIT
#pragma once

namespace vantage::python {

/// Makes the library's exceptions those of vantage.errors. Call once, when the module is made.
void translate_errors();

}  // namespace vantage::python
