// The table of subcommands: each declares its options and returns its action.
#pragma once

#include <functional>
#include <vector>

#include <CLI/CLI.hpp>

#include "fairway/app/session.hpp"

namespace fairway {

/// Runs a subcommand once its options are parsed; returns an ExitCode.
using Action = std::function<int(const Session&)>;

struct Command {
  const char* name;
  const char* does;
  Action (*declare)(CLI::App& options);
  bool writes;  ///< writes products, which --force may overwrite
};

// One file each.
Action declare_run(CLI::App& options);
Action declare_plan(CLI::App& options);
Action declare_simulate(CLI::App& options);
Action declare_improve(CLI::App& options);
Action declare_verify(CLI::App& options);
Action declare_query(CLI::App& options);
Action declare_check(CLI::App& options);
Action declare_draw(CLI::App& options);
Action declare_cell(CLI::App& options);
Action declare_export(CLI::App& options);
Action declare_steer(CLI::App& options);
Action declare_tune(CLI::App& options);
Action declare_contract(CLI::App& options);
Action declare_compare(CLI::App& options);
Action declare_ceiling(CLI::App& options);
Action declare_view(CLI::App& options);
Action declare_info(CLI::App& options);
Action declare_init(CLI::App& options);

}  // namespace fairway
