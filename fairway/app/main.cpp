// fairway: a table of subcommands, the global options, and how errors become exit codes.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include "fairway/app/command.hpp"
#include "fairway/app/ending.hpp"
#include "fairway/base/atomic_file.hpp"
#include "fairway/base/edit_distance.hpp"
#include "fairway/base/error.hpp"
#include "fairway/run/mission_on_map.hpp"
#include "fairway/run/scenario_keys.hpp"
#include "fairway/run/version.hpp"

namespace fairway {
namespace {

// To add a subcommand: a file with its declare function, and a line here.
constexpr Command commands[] = {
    {"run", "the main job: plan, fly, prove and draw a scenario, into one folder", declare_run,
     true},
    {"plan", "compute only the feedback plan", declare_plan, true},
    {"simulate", "fly a plan: exactly, or with a sampled control law in noise and wind",
     declare_simulate, true},
    {"improve", "change a plan's commands where proofs confirm that it helps", declare_improve,
     true},
    {"verify", "prove which states reach the goal, and write a certificate", declare_verify, true},
    {"query", "look up states in a certificate or a bitmap", declare_query, false},
    {"check", "re-prove a certificate with an independent program", declare_check, false},
    {"draw", "draw a plan or a certificate", declare_draw, true},
    {"cell", "list which headings lead from one border of a cell to another (paper 2)",
     declare_cell, true},
    {"export", "export a plan, a certificate or a bitmap as GeoTIFF for GIS programs",
     declare_export, true},
    {"steer", "steer to a pose by a shortest path or a control law, ignoring obstacles",
     declare_steer, true},
    {"tune", "find the parameters with which most states are proved", declare_tune, true},
    {"contract", "state what the vehicle keeps, from its numbers or its flight logs",
     declare_contract, true},
    {"compare", "compare plans over all states: what each proves and what its flights cost",
     declare_compare, true},
    {"ceiling", "bound from which states any control could succeed", declare_ceiling, true},
    {"view", "serve the interactive page of a run on this machine", declare_view, false},
    {"info", "describe a map (size, free and connected parts, clearance), a plan or a certificate",
     declare_info, true},
    {"init", "write a first scenario for a map, ready to run", declare_init, true},
};

/// Ctrl-C and the like must leave no partial files. A dedicated thread waits for the signals,
/// because it may do what a signal handler may not.
void tidy_up_on_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int s : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, s);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals] {
    int caught = 0;
    do sigwait(&signals, &caught);
    while (ends_gently());
    remove_unfinished();
    if (const std::string words = words_when_interrupted(); !words.empty()) {
      const char* const over_the_progress = ::isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "";
      complain(fmt::format("{}fairway: interrupted: {}", over_the_progress, words));
    }
    ::_exit(128 + caught);
  }).detach();
}

int fail(const Session& session, int code, const std::string& where, const std::string& message) {
  complain("fairway: " + message);
  if (session.json) {
    try {
      session.tell({{"error", message}, {"where", where}, {"exit_code", code}}, "");
    } catch (const OutputError&) {  // stderr and the exit code have already reported it
    }
  }
  return code;
}

int fail_to_print(std::string_view why) {
  complain(fmt::format("fairway: standard output could not be written{}{}", why.empty() ? "" : ": ",
                       why));
  return exit_output;
}

int perform(const Action& action, bool writes, const Session& session) {
  if (writes) say_when_interrupted("no partial files were left");
  std::optional<tbb::global_control> bound;
  if (session.threads > 0) {
    bound.emplace(tbb::global_control::max_allowed_parallelism,
                  static_cast<std::size_t>(session.threads));
  }
  try {
    return action(session);
  } catch (const WarnedInputError& error) {
    for (const std::string& warning : error.warnings) session.warn(warning);
    return fail(session, exit_input, error.where(), error.what());
  } catch (const OutputError& error) {
    return fail_to_print(error.what());
  } catch (const InputError& error) {
    return fail(session, exit_input, error.where(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(session, exit_fault, "", "out of memory; larger cells use less");
  } catch (const std::exception& error) {
    return fail(session, exit_fault, "",
                fmt::format("internal error (please report it): {}", error.what()));
  }
}

/// The options common to all commands, accepted before the command's name or after it.
void declare_common(CLI::App& app, bool writes, Session& session, const std::string& group) {
  app.add_option("--threads", session.threads,
                 "number of threads (default: all cores); does not affect results")
      ->check(CLI::Range(1, 4096))
      ->type_name("N")
      ->group(group);
  app.add_flag("--quiet", session.quiet, "suppress progress and the final summary")->group(group);
  app.add_flag("--json", session.json, "print one JSON object to stdout")->group(group);
  if (writes) {
    app.add_flag("--force", session.force, "overwrite existing products")->group(group);
  }
}

/// The error for a first word that is not a command, with a guess at what was meant.
std::string no_command_words(const std::string& word) {
  if (word.starts_with("-")) return fmt::format("unknown option {}; see fairway --help", word);
  std::error_code error;
  const std::filesystem::path path(word);
  if (path.extension() == ".toml") {
    return fmt::format("{} is not a command; did you mean fairway run {}?", word, word);
  }
  if (std::filesystem::is_directory(path, error)) {
    return fmt::format("{} is not a command; did you mean fairway view {}?", word, word);
  }
  const std::string known = word.substr(0, 64);
  const Command* best = &commands[0];
  std::string all;
  for (const Command& command : commands) {
    if (edit_distance(known, command.name) < edit_distance(known, best->name)) best = &command;
    all += (all.empty() ? "" : ", ") + std::string(command.name);
  }
  if (edit_distance(known, best->name) <= 2) {
    return fmt::format("unknown command {}; did you mean {}?", word, best->name);
  }
  return fmt::format("unknown command {}, expected one of {}", word, all);
}

int main_with(int argc, char** argv) {
  Session session;
  CLI::App app("Verified feedback motion plans for vehicles with a minimum turning radius.",
               "fairway");
  app.set_version_flag("--version", program_version);
  declare_common(app, true, session, "Options");
  bool show_keys = false;
  app.add_flag("--scenario-keys", show_keys, "print every scenario key with its range and default");
  app.footer(
      "Exit codes: 0 success, whatever the verdicts and outcomes; 1 negative result (the goal "
      "cannot be reached from anywhere, the certificate was refused); 64 wrong usage; 65 bad input "
      "(reported with file and line); 70 internal error; 74 standard output could not be written; "
      "130 interrupted by Ctrl-C.");
  app.require_subcommand(0, 1);
  app.fallthrough();

  struct Declared {
    CLI::App* options;
    Action action;
    bool writes;
  };
  std::vector<Declared> declared;
  for (const Command& command : commands) {
    CLI::App* options = app.add_subcommand(command.name, command.does);
    declared.push_back({options, command.declare(*options), command.writes});
    declare_common(*options, command.writes, session, "Common options");
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError&) {
    if (app.get_subcommands().empty()) {
      complain("fairway: " + no_command_words(app.remaining().front()));
      return exit_usage;
    }
    const std::string command = app.get_subcommands().front()->get_name();
    complain(fmt::format("fairway {}: unexpected argument: {}; see fairway {} --help", command,
                         fmt::join(app.remaining(true), " "), command));
    return exit_usage;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_done : exit_usage;
  }
  if (show_keys) {
    std::cout << scenario_keys_markdown();
    return exit_done;
  }
  for (const Declared& d : declared) {
    if (d.options->parsed()) return perform(d.action, d.writes, session);
  }
  complain(app.help());
  return exit_usage;
}

/// A standard descriptor that the caller closed would be reused for the next file opened, and
/// output would end up in that file. Opens a placeholder to which writing still fails.
void keep_standard_descriptors() {
  for (const auto& [descriptor, way] :
       {std::pair{STDIN_FILENO, O_WRONLY}, {STDOUT_FILENO, O_RDONLY}, {STDERR_FILENO, O_WRONLY}}) {
    if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    const int opened = ::open("/dev/null", way);  // takes the lowest free descriptor: this one
    if (opened >= 0 && opened != descriptor) ::close(opened);
  }
}

/// Output counts as written only once it is flushed; help and version included.
int when_written(int code) {
  if (code == exit_output) return code;  // already reported
  errno = 0;
  std::cout.flush();
  const bool flushed = std::fflush(stdout) == 0;
  const int error = errno;
  if (flushed && std::ferror(stdout) == 0 && std::cout.good()) return code;
  const int lost = fail_to_print(error == 0 ? "" : std::strerror(error));
  return code == exit_done ? lost : code;
}

}  // namespace
}  // namespace fairway

int main(int argc, char** argv) {
#ifdef __GLIBC__
  // Large arrays are given back as soon as they are freed. (Of itself, malloc soon keeps them in
  // its heap, where what lies behind them keeps them in memory.)
  mallopt(M_MMAP_THRESHOLD, 256 * 1024);
  mallopt(M_TRIM_THRESHOLD, 256 * 1024);
#endif
  fairway::keep_standard_descriptors();
  fairway::tidy_up_on_signals();
  return fairway::when_written(fairway::main_with(argc, argv));
}
