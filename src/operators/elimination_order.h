// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/SparseCore>

namespace vantage {

/// An order in which the unknowns of a sparse symmetric system are eliminated with little fill:
/// entry k is the unknown that goes k-th. Approximate minimum degree (Amestoy, Davis, Duff 1996) for
/// small systems, nested dissection (Karypis, Kumar 1998) for large ones.
/// \param A square, compressed; the lower triangle is used.
std::vector<int> elimination_order(const Eigen::SparseMatrix<double>& A);

}  // namespace vantage
