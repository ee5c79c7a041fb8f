// fairway view: the page of a run, live.
#include <array>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fairway/app/command.hpp"
#include "fairway/app/ending.hpp"
#include "fairway/base/error.hpp"
#include "fairway/run/products.hpp"
#include "fairway/view/engine.hpp"
#include "fairway/view/page_server.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

/// Always the same when it can be had, so that the address can be kept.
constexpr int usual_port = 8642;

struct ViewArguments {
  fs::path folder;
  int port = usual_port;
  bool port_given = false;
  bool open = false;
};

std::unique_ptr<PageServer> server_for(const ViewArguments& a, const LiveEngine& engine) {
  try {
    return std::make_unique<PageServer>(a.folder, engine, a.port);
  } catch (const InputError&) {
    if (a.port_given) throw;
    return std::make_unique<PageServer>(a.folder, engine, 0);
  }
}

/// What the desktop shows addresses with, by itself. False when there is none to run.
bool open_browser(std::string address) {
  std::string program = "xdg-open";
  std::array<char*, 3> words{program.data(), address.data(), nullptr};
  posix_spawn_file_actions_t silent;
  posix_spawn_file_actions_init(&silent);
  for (const int d : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&silent, d, "/dev/null", O_RDWR, 0);
  }
  // The signals that this process keeps for a thread of its own are the browser's again, and
  // Ctrl-C is not meant for it.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  pid_t child = 0;
  const int failed = ::posix_spawnp(&child, words[0], &silent, &attributes, words.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&silent);
  if (failed != 0) return false;
  std::thread([child] { ::waitpid(child, nullptr, 0); }).detach();
  return true;
}

int view_command(const ViewArguments& a, const Session& session) {
  if (!fs::is_directory(a.folder)) {
    throw InputError(a.folder.string(), "is no folder: expected what `fairway run` made");
  }
  if (!fs::exists(a.folder / product::report_page)) {
    throw InputError(
        (a.folder / product::report_page).string(),
        "is not there: expected the folder of a `fairway run` whose build has the page "
        "(docs/report.md)");
  }
  const LiveEngine engine(a.folder);
  const std::unique_ptr<PageServer> server = server_for(a, engine);
  const EndsGently gently([&server] { server->stop(); });
  session.tell({{"address", server->address()}, {"port", server->port()}},
               fmt::format("{} shows {}; Ctrl-C ends it.", server->address(), a.folder.string()));
  if (a.open && !open_browser(server->address())) {
    session.warn("xdg-open could not be run: open " + server->address() + " in a browser");
  }
  server->serve();
  return exit_done;
}

}  // namespace

Action declare_view(CLI::App& options) {
  auto arguments = std::make_shared<ViewArguments>();
  options.add_option("folder", arguments->folder, "a folder that `fairway run` made")
      ->required()
      ->type_name("DIR");
  options
      .add_option(
          "--port", arguments->port,
          fmt::format("port on 127.0.0.1, 0 for a free one (default: {}, or a free one when "
                      "that is taken)",
                      usual_port))
      ->check(CLI::Range(0, 65535))
      ->type_name("N")
      ->each([arguments](const std::string&) { arguments->port_given = true; });
  options.add_flag("--open", arguments->open, "show the page in a browser, by xdg-open");
  options.footer(
      "Serves DIR/report.html and the run's other products on this machine alone, and\n"
      "answers what the page asks: verdicts, flights and ways to a pose. Prints the address.\n"
      "Example: fairway view out/demo");
  return [arguments](const Session& session) { return view_command(*arguments, session); };
}

}  // namespace fairway
