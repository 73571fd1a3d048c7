// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "batch/confined_folder.h"
#include "batch/model_record.h"
#include "batch/result_book.h"

/// \file
/// Results that equal models share, when the model that was run gets others.

namespace vantage::batch {

/// The first of the models that have the results of `former`, if these are there.
std::optional<ModelRecord> heir_of(ResultBook& book, const ConfinedFolder& root,
                                   const ModelRecord& former);

/// The folder `wanted`, or one with a number behind it where something is in its place.
/// \param is_claimed whether results will come into a folder.
std::string free_folder(const ConfinedFolder& root, const std::string& wanted,
                        const std::function<bool(const std::string&)>& is_claimed);

/// Gives the results of `former` to its heir. \param folder where they are from then on.
/// \throw IoError
void hand_over(ResultBook& book, const ConfinedFolder& root, ModelRecord heir,
               const ModelRecord& former, const std::string& folder);

/// Makes the models that have the results of `former` duplicates of `now`, whose results are in their place.
/// \throw IoError
void make_equal(ResultBook& book, const ModelRecord& former, const ModelRecord& now);

}  // namespace vantage::batch
