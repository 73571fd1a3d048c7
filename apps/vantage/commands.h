// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include <CLI/CLI.hpp>

#include "session.h"

/// \file
/// One function a command: it adds the command's flags and, when the command line names it, does
/// the work. Each lives in a file of its name.

namespace vantage::cli {

void add_view_command(CLI::App& program, Session& session);
void add_skeleton_command(CLI::App& program, Session& session);
void add_map_command(CLI::App& program, Session& session);
void add_score_command(CLI::App& program, Session& session);
void add_compare_command(CLI::App& program, Session& session);
void add_eval_command(CLI::App& program, Session& session);
void add_measures_command(CLI::App& program, Session& session);
void add_render_command(CLI::App& program, Session& session);
void add_thumb_command(CLI::App& program, Session& session);
void add_info_command(CLI::App& program, Session& session);
void add_orient_command(CLI::App& program, Session& session);
void add_batch_command(CLI::App& program, Session& session);
void add_batch_worker_commands(CLI::App& program, Session& session);
void add_results_command(CLI::App& program, Session& session);
void add_serve_command(CLI::App& program, Session& session);
void add_figures_command(CLI::App& program, Session& session);
void add_completion_command(CLI::App& program, Session& session);
void add_manual_command(CLI::App& program, Session& session);

/// Adds a command that keeps its flags in a `Command` and runs its `run(session)`.
template <class Command>
Command& add_command(CLI::App& program, Session& session, const char* name, const char* help,
                     const char* examples) {
  CLI::App* app = program.add_subcommand(name, help);
  auto command = std::make_shared<Command>();
  command->add_flags(*app, session);
  app->footer(examples);
  app->final_callback([command, app, &session] {
    session.apply_limits();  // settings may be read from a pipe that nobody writes to
    session.configure(*app);
    session.apply_limits();
    command->run(session);
  });
  return *command;
}

}  // namespace vantage::cli
