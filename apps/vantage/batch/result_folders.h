// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "batch/confined_folder.h"
#include "batch/model_record.h"

/// \file
/// Where in a batch's folder the results of models are, and work in progress.

namespace vantage::batch {

/// Name, in a batch's folder, of the folder that holds what is being worked on; its contents may be
/// lost.
std::string work_folder(const std::string& work_name);

/// Name, in a batch's folder, of a model's results. \param folder as its record has it.
std::string model_folder(const std::string& folder);

/// Whether a model's place holds results that a worker has made: only such a folder is ever removed.
bool holds_results(const ConfinedFolder& root, const std::string& folder);

/// Whether all files that a record names are there, as large as it says.
bool holds_named_files(const ConfinedFolder& root, const ModelRecord& record);

/// Whether there is nothing in a model's place, or results of ours.
bool may_be_replaced(const ConfinedFolder& root, const std::string& folder);

}  // namespace vantage::batch
