// fairway view: serves the page of a run with live queries.
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

/// Always the same when it is available, so that the address can be bookmarked.
constexpr int usual_port = 8642;

struct ViewArguments {
  fs::path folder;
  fs::path contract_certificate;
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

/// Opens the desktop's browser as a separate process. False when it cannot be started.
bool open_browser(std::string address) {
  std::string program = "xdg-open";
  std::array<char*, 3> words{program.data(), address.data(), nullptr};
  posix_spawn_file_actions_t silent;
  posix_spawn_file_actions_init(&silent);
  for (const int d : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&silent, d, "/dev/null", O_RDWR, 0);
  }
  // Unblock the signals that this process handles in a thread, and put the browser into its own
  // process group, because Ctrl-C is not meant for it.
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
    throw InputError(a.folder.string(),
                     "is not a folder; expected the output folder of `fairway run`");
  }
  if (!fs::exists(a.folder / product::report_page)) {
    throw InputError(
        (a.folder / product::report_page).string(),
        "not found; expected the output folder of a `fairway run` whose build includes the page "
        "(docs/report.md)");
  }
  const LiveEngine engine(a.folder, {}, a.contract_certificate);
  const std::unique_ptr<PageServer> server = server_for(a, engine);
  const EndsGently gently([&server] { server->stop(); });
  session.tell({{"address", server->address()}, {"port", server->port()}},
               fmt::format("{} shows {}; Ctrl-C ends it.", server->address(), a.folder.string()));
  if (a.open && !open_browser(server->address())) {
    session.warn("xdg-open could not be run; open " + server->address() + " in a browser");
  }
  server->serve();
  return exit_done;
}

}  // namespace

Action declare_view(CLI::App& options) {
  auto arguments = std::make_shared<ViewArguments>();
  options.add_option("folder", arguments->folder, "the output folder of `fairway run`")
      ->required()
      ->type_name("DIR");
  options
      .add_option("--contract-certificate", arguments->contract_certificate,
                  "a contract certificate of the folder's plan, instead of the run's own")
      ->type_name("CERT");
  options
      .add_option(
          "--port", arguments->port,
          fmt::format("port on 127.0.0.1, 0 for a free one (default: {}, or a free one if that "
                      "is in use)",
                      usual_port))
      ->check(CLI::Range(0, 65535))
      ->type_name("N")
      ->each([arguments](const std::string&) { arguments->port_given = true; });
  options.add_flag("--open", arguments->open, "open the page in a browser, using xdg-open");
  options.footer(
      "Serves DIR/report.html and the run's other products to this machine only, and answers the\n"
      "page's queries: verdicts, of the exact vehicle and under its contract, flights and paths "
      "to\n"
      "a pose. Prints the address.\n"
      "Example: fairway view out/demo");
  return [arguments](const Session& session) { return view_command(*arguments, session); };
}

}  // namespace fairway
