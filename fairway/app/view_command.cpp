// fairway view: the page of a run, live.
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "fairway/app/command.hpp"
#include "fairway/app/ending.hpp"
#include "fairway/base/error.hpp"
#include "fairway/run/products.hpp"
#include "fairway/view/engine.hpp"
#include "fairway/view/page_server.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

struct ViewArguments {
  fs::path folder;
  int port = 0;
};

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
  PageServer server(a.folder, engine, a.port);
  const EndsGently gently([&server] { server.stop(); });
  session.tell({{"address", server.address()}, {"port", server.port()}},
               fmt::format("{} shows {}; Ctrl-C ends it.", server.address(), a.folder.string()));
  server.serve();
  return exit_done;
}

}  // namespace

Action declare_view(CLI::App& options) {
  auto arguments = std::make_shared<ViewArguments>();
  options.add_option("folder", arguments->folder, "a folder that `fairway run` made")
      ->required()
      ->type_name("DIR");
  options.add_option("--port", arguments->port, "port on 127.0.0.1 (default: 0, a free one)")
      ->check(CLI::Range(0, 65535))
      ->type_name("N");
  options.footer(
      "Serves DIR/report.html and the run's other products on this machine alone, and\n"
      "answers what the page asks: verdicts, flights and ways to a pose.\n"
      "Example: fairway view out/demo");
  return [arguments](const Session& session) { return view_command(*arguments, session); };
}

}  // namespace fairway
