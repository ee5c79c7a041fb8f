#include "fairway/view/page_server.hpp"

#include <cerrno>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <ifaddrs.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include "fairway/base/error.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/map/testing/scratch_folder.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/report/testing/plans_to_draw.hpp"
#include "fairway/run/ask_contract.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/run/plan_map.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/runtime.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/view/engine.hpp"
#include "fairway/view/question.hpp"

namespace fairway {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

Plan island() {
  Plan plan = testing::island_plan({30, 24, -8.0, 4.0, 4.0}, {80.0, 60.0}, {10, 12});
  plan.vehicle = {10.0, 9.0};
  plan.record.mission = GoalMission{{80.0, 60.0}, {}};
  return plan;
}

Certificate certificate_of(const Plan& plan) {
  CertifyOptions options;
  options.undecided_max = 0.2;
  return verify_plan(plan, "test", {}, options).certificate;
}

/// A run's folder with a page, a plan and a certificate; a server over it.
class Served : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    plan_ = island();
    certificate_ = certificate_of(plan_);
  }
  void SetUp() override {
    place_ = fs::path(folder_.file("run"));
    fs::create_directory(place_);
    write_plan(plan_, place_ / "plan.safetensors", Existing::keep);
    write_certificate(certificate_, place_ / "certificate.safetensors", Existing::keep);
    std::ofstream(place_ / "report.html") << "<!doctype html>page";
    std::ofstream(place_ / "secret.txt") << "secret";
    std::ofstream(place_ / ".." / "outside.txt") << "outside";
    fs::create_symlink(place_ / ".." / "outside.txt", place_ / "flights.csv");
    fs::create_directory(place_ / "outcomes.csv");
    engine_.emplace(place_);
    server_.emplace(place_, *engine_, 0);
    thread_ = std::thread([this] { server_->serve(); });
    // Until it answers.
    for (int tries = 0; tries < 500 && !get("/"); ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  void TearDown() override {
    server_->stop();
    thread_.join();
  }

  httplib::Client client() const { return httplib::Client("127.0.0.1", server_->port()); }
  httplib::Result get(const std::string& path, const httplib::Headers& headers = {}) const {
    return client().Get(path, headers);
  }
  json answer(const std::string& path, int status) const {
    const auto result = get(path);
    if (!result) throw std::runtime_error("no answer to " + path);
    EXPECT_EQ(result->status, status) << path << ": " << result->body;
    EXPECT_EQ(result->get_header_value("Content-Type"), "application/json");
    return json::parse(result->body);
  }
  std::string error(const std::string& path, int status) const {
    return answer(path, status).at("error").get<std::string>();
  }
  /// The reply to exactly these bytes.
  std::string raw(const std::string& bytes) const {
    const int connection = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(server_->port()));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(connection, reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
    EXPECT_EQ(::send(connection, bytes.data(), bytes.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(bytes.size()));
    const timeval patience{0, 300'000};
    ::setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    std::string back;
    char part[4096];
    for (ssize_t n = 0; (n = ::recv(connection, part, sizeof part, 0)) > 0;) {
      back.append(part, static_cast<std::size_t>(n));
    }
    ::close(connection);
    return back;
  }

  const ScratchFolder folder_;
  fs::path place_;
  static inline Plan plan_;
  static inline Certificate certificate_;
  std::optional<LiveEngine> engine_;
  std::optional<PageServer> server_;
  std::thread thread_;
};

TEST_F(Served, ThePageAndTheProductsOfARunByTheirNames) {
  for (const char* path : {"/", "/report.html"}) {
    const auto page = get(path);
    ASSERT_TRUE(page);
    EXPECT_EQ(page->status, 200);
    EXPECT_EQ(page->body, "<!doctype html>page");
    EXPECT_EQ(page->get_header_value("Content-Type"), "text/html; charset=utf-8");
    EXPECT_EQ(page->get_header_value("X-Content-Type-Options"), "nosniff");
    EXPECT_FALSE(page->has_header("Access-Control-Allow-Origin"));
  }
  const auto plan = get("/plan.safetensors");
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->body.size(), fs::file_size(place_ / "plan.safetensors"));
  EXPECT_EQ(client().Head("/report.html")->body, "");
}

TEST_F(Served, NothingElseOfTheFolderAndNothingOutsideIt) {
  for (const char* path :
       {"/secret.txt", "/summary.json", "/flights.csv", "/outcomes.csv", "/../outside.txt",
        "/%2e%2e/outside.txt", "/..%2foutside.txt", "/run/../report.html", "//report.html",
        "/report.html/", "/./report.html", "/report.html%00.txt", "/etc/passwd", "/api", "/api/",
        "/api/nothing", "/api/info/", "/favicon.ico"}) {
    const auto result = get(path);
    ASSERT_TRUE(result) << path;
    EXPECT_EQ(result->status, 404) << path << ": " << result->body;
    EXPECT_TRUE(json::parse(result->body).contains("error")) << path;
  }
}

TEST_F(Served, MalformedQuestionsGetAReason) {
  EXPECT_EQ(error("/api/state?x=1&y=10", 400), "parameter \"h\" is missing, expected once");
  EXPECT_EQ(error("/api/state?x=1&x=2&y=10&h=0", 400),
            "parameter \"x\" is repeated, expected once");
  EXPECT_EQ(error("/api/state?x=one&y=10&h=0", 400), "x: \"one\" is not a finite decimal number");
  EXPECT_NE(error("/api/steer?x=1e5&y=10&h=0&to_x=1&to_y=10&to_h=0", 400).find("outside the plan"),
            std::string::npos);
  EXPECT_NE(error("/api/state?x=1&y=10&h=0&goal_x=1", 400).find("\"goal_y\" is missing"),
            std::string::npos);
  EXPECT_NE(error("/api/replan?goal_x=1&goal_y=nan", 400).find("not a finite"), std::string::npos);
  EXPECT_NE(error("/api/state?x=1&y=10&h=0&z=1", 400).find("unknown parameter"), std::string::npos);
  EXPECT_NE(error("/api/info?x=1", 400).find("unknown parameter"), std::string::npos);
  EXPECT_NE(error("/?x=1", 400).find("unknown parameter"), std::string::npos);
  EXPECT_NE(error("/api/steer?x=1&y=10&h=0", 400).find("missing"), std::string::npos);
}

TEST_F(Served, MalformedRequestsGetA400AndTheServerGoesOn) {
  const std::vector<std::string> garbage{"GARBAGE\r\n\r\n",
                                         "GET\r\n\r\n",
                                         "GET / FTP/1\r\n\r\n",
                                         std::string("\0\1\2\3\r\n\r\n", 8),
                                         "GET / HTTP/1.1\r\nHost: localhost\r\nbroken\r\n\r\n",
                                         "GET /" + std::string(20'000, 'a') + " HTTP/1.1\r\n\r\n"};
  for (const std::string& bytes : garbage) {
    const std::string back = raw(bytes);
    EXPECT_TRUE(back.empty() || back.starts_with("HTTP/1.1 4")) << bytes.substr(0, 40) << back;
  }
  EXPECT_TRUE(raw("GARBAGE\r\n\r\n").starts_with("HTTP/1.1 400"));
  EXPECT_EQ(get("/")->status, 200);
}

TEST_F(Served, OtherMethodsGetA405) {
  auto http = client();
  for (const httplib::Result& result :
       {http.Post("/api/info", "x", "text/plain"), http.Put("/report.html", "x", "text/plain"),
        http.Delete("/report.html"), http.Patch("/", "x", "text/plain"), http.Options("/")}) {
    ASSERT_TRUE(result);
    EXPECT_EQ(result->status, 405);
    EXPECT_EQ(result->get_header_value("Allow"), "GET, HEAD");
  }
  EXPECT_TRUE(fs::exists(place_ / "report.html"));
}

TEST_F(Served, OtherHostsAreRefused) {
  const std::string port = std::to_string(server_->port());
  EXPECT_EQ(get("/", {{"Host", "localhost:" + port}})->status, 200);
  const std::vector<std::string> others{"evil.example:" + port, "localhost", "127.0.0.1:1", ""};
  for (const std::string& host : others) {
    EXPECT_EQ(get("/", {{"Host", host}})->status, 403) << host;
    EXPECT_EQ(get("/api/info", {{"Host", host}})->status, 403) << host;
  }
  EXPECT_NE(raw("GET / HTTP/1.1\r\nConnection: close\r\n\r\n").find("403"),
            std::string::npos);  // without a Host header
}

TEST_F(Served, RequestsFromOtherPagesInABrowserAreRefused) {
  for (const char* site : {"cross-site", "same-site", "anything"}) {
    EXPECT_EQ(get("/api/info", {{"Sec-Fetch-Site", site}})->status, 403) << site;
    EXPECT_EQ(get("/api/proof?goal_x=1&goal_y=10", {{"Sec-Fetch-Site", site}})->status, 403);
  }
  for (const char* site : {"same-origin", "none"}) {
    EXPECT_EQ(get("/api/info", {{"Sec-Fetch-Site", site}})->status, 200) << site;
  }
}

TEST_F(Served, NoOtherAddressOfThisMachineAnswers) {
  ifaddrs* all = nullptr;
  ASSERT_EQ(::getifaddrs(&all), 0);
  int others = 0;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    auto to = *reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    if (ntohl(to.sin_addr.s_addr) == INADDR_LOOPBACK) continue;
    ++others;
    to.sin_port = htons(static_cast<std::uint16_t>(server_->port()));
    const int connection = ::socket(AF_INET, SOCK_STREAM, 0);
    EXPECT_NE(::connect(connection, reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
    ::close(connection);
  }
  ::freeifaddrs(all);
  // 127.0.0.2 is this machine on every Linux, so there is always one address to try.
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(server_->port()));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK + 1);
  const int connection = ::socket(AF_INET, SOCK_STREAM, 0);
  EXPECT_NE(::connect(connection, reinterpret_cast<sockaddr*>(&to), sizeof to), 0) << others;
  ::close(connection);
}

TEST_F(Served, APortThatIsTakenIsAnError) {
  try {
    const PageServer second(place_, *engine_, server_->port());
    FAIL() << "two servers share a port";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), "--port");
  }
}

TEST_F(Served, StatesGetTheAnswersOfTheCertificateAndTheSimulator) {
  runtime::Certificate certificate;
  const MappedFile file(place_ / "certificate.safetensors");
  ASSERT_EQ(certificate.open(file.bytes().data(), file.bytes().size()), runtime::Status::ok);
  const ExactFlights flights(plan_);
  Random random = Random::stream(5, 0);
  int reached = 0;
  for (int k = 0; k < 60; ++k) {
    const double x = random.uniform(-8.0, 111.9), y = random.uniform(4.0, 99.9);
    const double h = random.uniform(-3.0, 3.0);
    const json found = answer(fmt::format("/api/state?x={}&y={}&h={}", x, y, h), 200);
    const runtime::Answer expected = certificate.query(x, y, h);
    EXPECT_EQ(found["verdict"], name_of(expected.verdict));
    const Flight flight = flights.record({{x, y}, Heading::from_rad(h)});
    EXPECT_EQ(found["flight"]["outcome"], name_of(flight.result.outcome));
    EXPECT_EQ(found["flight"]["pieces"].size(), flight.segments.size());
    EXPECT_FALSE(found["flight"].contains("leg"));
    if (expected.verdict != Verdict::reach) {
      EXPECT_TRUE(found["time_bound_s"].is_null());
      continue;
    }
    ++reached;
    EXPECT_EQ(found["time_bound_s"], expected.time_bound_s);
    EXPECT_EQ(found["flight"]["time_s"], flight.result.time_s);
    EXPECT_LE(flight.result.time_s, expected.time_bound_s);
    if (flight.segments.empty()) continue;  // in the goal
    const json& first = found["flight"]["pieces"][0];
    EXPECT_EQ(first[0], x);
    EXPECT_EQ(first[1], y);
  }
  EXPECT_GT(reached, 10);
}

TEST_F(Served, AStateOutsideThePlanHasLeftAsAQueryOfTheCertificateSays) {
  runtime::Certificate certificate;
  const MappedFile file(place_ / "certificate.safetensors");
  ASSERT_EQ(certificate.open(file.bytes().data(), file.bytes().size()), runtime::Status::ok);
  for (const Vec2 p :
       {Vec2{-9.0, 50.0}, Vec2{113.0, 50.0}, Vec2{50.0, 3.0}, Vec2{1e5, -1e5}, Vec2{1e300, 10.0}}) {
    const json found = answer(fmt::format("/api/state?x={}&y={}&h=0.3", p.x, p.y), 200);
    EXPECT_EQ(found["verdict"], name_of(certificate.query(p.x, p.y, 0.3).verdict));
    EXPECT_EQ(found["flight"]["outcome"], "leave");
    EXPECT_EQ(found["flight"]["time_s"], 0.0);
    EXPECT_TRUE(found["flight"]["pieces"].empty());
    EXPECT_EQ(found["verdict"], std::abs(p.x) < 1e9 ? "leave" : "undecided");
  }
}

TEST_F(Served, APlanThatCannotBeMadeAgainSaysWhyItsGoalCannotBeMoved) {
  const json info = answer("/api/info", 200);
  EXPECT_EQ(info["replan"], false);  // made by hand, without options
  const std::string why = info["replan_refused"].get<std::string>();
  EXPECT_NE(why.find("names no options"), std::string::npos);
  for (const char* question : {"/api/replan?goal_x=70&goal_y=20", "/api/proof?goal_x=70&goal_y=20",
                               "/api/state?x=1&y=10&h=0&goal_x=70&goal_y=20"}) {
    EXPECT_EQ(error(question, 400), why) << question;
  }
}

TEST(LiveEngine, AMovedGoalHasItsOwnPlanFlightsAndProof) {
  const ScratchFolder folder;
  const fs::path place(folder.file(""));
  ObstacleMap map;
  map.grid = {50, 40, 0.0, 0.0, 4.0};
  map.obstacle.assign(map.grid.size(), 0);
  for (int iy = 18; iy < 24; ++iy) {
    for (int ix = 20; ix < 26; ++ix) map.obstacle[map.grid.index({ix, iy})] = 1;
  }
  FieldOptions options;
  options.alpha = 1.0;
  const Plan plan =
      std::get<Plan>(plan_map(map, {10.0, 9.0}, GoalMission{{150.0, 40.0}, {}}, options));
  write_plan(plan, place / "plan.safetensors", Existing::keep);
  const LiveEngine engine(place);
  EXPECT_EQ(engine.info()["replan"], true);
  const Vec2 moved{40.0, 120.0};
  const json found = engine.replan(moved);
  EXPECT_EQ(found["mission"]["goal_m"], json({40.0, 120.0}));
  EXPECT_TRUE(found["refused"].is_null());
  EXPECT_GT(found["arrays"].get<std::string>().size(), 1000U);

  const State start{{170.0, 30.0}, Heading::from_rad(2.0)};
  const json flown = engine.state(start, moved);
  EXPECT_EQ(flown["flight"]["outcome"], "reach");
  EXPECT_TRUE(flown["verdict"].is_null()) << "not verified";
  const auto& last = flown["flight"]["pieces"].back();
  EXPECT_LT(std::hypot(last[0].get<double>() - moved.x, last[1].get<double>() - moved.y), 80.0);
  EXPECT_NE(engine.state(start)["flight"], flown["flight"]);

  const json proof = engine.proof(moved);
  EXPECT_GT(proof["volume_fraction"]["reach"].get<double>(), 0.5);
  EXPECT_EQ(proof["verdicts"]["nx"], 50);
  EXPECT_EQ(found["verified"], false);
  EXPECT_EQ(engine.replan(moved)["verified"], true);
  EXPECT_EQ(engine.state(start, moved)["verdict"], "reach");

  const json refused = engine.replan({92.0, 84.0});
  EXPECT_NE(refused["refused"].get<std::string>().find("lies in an obstacle"), std::string::npos);
  EXPECT_THROW(static_cast<void>(engine.state(start, Vec2{92.0, 84.0})), BadQuestion);
}

TEST_F(Served, SteeringEndsAtThePoseAndReportsObstaclesInTheWay) {
  const json open = answer("/api/steer?x=70&y=20&h=0&to_x=90&to_y=80&to_h=1.5", 200);
  EXPECT_EQ(open["state"], "shortest");
  EXPECT_EQ(open["word"], open["shortest"]["word"]);
  EXPECT_GT(open["length_m"], 60.0);
  const json& last = open["pieces"].back();
  const FlightSegment piece{
      {{last[0], last[1]}, Heading::from_rad(last[2])}, 0.0, last[3], last[4]};
  const State end = state_at(piece, last[3]);
  EXPECT_NEAR(end.position_m.x, 90.0, 1e-6);
  EXPECT_NEAR(end.position_m.y, 80.0, 1e-6);
  EXPECT_NEAR(end.heading.rad(), 1.5, 1e-9);
  // The rock is around (34, 54).
  const json blocked = answer("/api/steer?x=10&y=54&h=0&to_x=60&to_y=54&to_h=0", 200);
  EXPECT_NE(blocked["state"], "shortest");
  EXPECT_NEAR(blocked["shortest"]["length_m"].get<double>(), 50.0, 1e-6);
}

TEST_F(Served, InfoSaysWhichPlanThisIs) {
  const json info = answer("/api/info", 200);
  EXPECT_EQ(info["live"], true);
  EXPECT_EQ(info["verdicts"], true);
  EXPECT_EQ(info["plan_sha256"], json::parse(json_text(plan_digests(plan_))));
}

TEST_F(Served, ProductsAreSentWholeWhateverRangeIsAskedFor) {
  const std::string whole = "<!doctype html>page";
  for (const char* part : {"bytes=0-5", "bytes=3-", "bytes=-4", "bytes=0-1,4-5", "bytes=900-"}) {
    const auto page = get("/report.html", {{"Range", part}});
    ASSERT_TRUE(page) << part;
    EXPECT_EQ(page->status, 200) << part;
    EXPECT_EQ(page->body, whole) << part;
    EXPECT_FALSE(page->has_header("Content-Range")) << part;
    EXPECT_EQ(page->get_header_value("Accept-Ranges"), "none") << part;
  }
  const auto head = client().Head("/report.html", {{"Range", "bytes=0-5"}});
  EXPECT_EQ(head->status, 200);
  EXPECT_EQ(head->get_header_value("Content-Length"), std::to_string(whole.size()));
  EXPECT_EQ(head->get_header_value_count("Accept-Ranges"), 1U);
  EXPECT_EQ(head->get_header_value("Accept-Ranges"), "none");
}

std::size_t answers_in(const std::string& bytes) {
  std::size_t count = 0;
  for (auto at = bytes.find("HTTP/1.1 "); at != std::string::npos; ++count) {
    at = bytes.find("HTTP/1.1 ", at + 1);
  }
  return count;
}

TEST_F(Served, PipelinedRequestsAreAnsweredOneByOneAndABodyIsNotReadAsOne) {
  const std::string host = fmt::format(" HTTP/1.1\r\nHost: localhost:{}\r\n", server_->port());
  const std::string ask = "GET /api/info" + host + "\r\n";
  EXPECT_EQ(answers_in(raw(ask + ask + ask)), 3U);
  const std::string with_body =
      raw("GET /api/info" + host + fmt::format("Content-Length: {}\r\n\r\n", ask.size()) + ask);
  EXPECT_EQ(answers_in(with_body), 1U) << with_body;
  EXPECT_NE(with_body.find("Connection: close"), std::string::npos);
}

/// A separate server on the same folder.
class Limited {
 public:
  Limited(const fs::path& place, const LiveEngine& engine, const PageLimits& limits)
      : server_(place, engine, 0, limits), thread_([this] { server_.serve(); }) {}
  ~Limited() {
    server_.stop();
    thread_.join();
  }
  Limited(const Limited&) = delete;
  Limited& operator=(const Limited&) = delete;

  int connection() const {
    const int made = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(server_.port()));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(made, reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
    const timeval patience{30, 0};
    ::setsockopt(made, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    return made;
  }
  int port() const { return server_.port(); }
  /// The status of the page, 0 when none arrives within half a minute.
  int status() const {
    httplib::Client client("127.0.0.1", server_.port());
    client.set_read_timeout(30);
    const auto page = client.Get("/");
    return page ? page->status : 0;
  }

 private:
  PageServer server_;
  std::thread thread_;
};

/// Clients that send a byte of a request now and then, for at most half a minute.
class Dripping {
 public:
  Dripping(const Limited& server, int count) {
    for (int i = 0; i < count; ++i) connections_.push_back(server.connection());
    thread_ = std::jthread([this](const std::stop_token& stop) {
      const std::string request = "GET / HTTP/1.1\r\nX: " + std::string(4000, 'x');
      for (std::size_t at = 0; at < 1500 && !stop.stop_requested(); ++at) {
        for (const int c : connections_) ::send(c, &request[at], 1, MSG_NOSIGNAL | MSG_DONTWAIT);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    });
  }
  ~Dripping() {
    thread_.request_stop();
    thread_.join();
    for (const int c : connections_) ::close(c);
  }
  Dripping(const Dripping&) = delete;
  Dripping& operator=(const Dripping&) = delete;

  /// How many were disconnected while still sending.
  int let_go() const {
    int count = 0;
    for (const int c : connections_) {
      char part[4096];
      ssize_t n = 0;
      while ((n = ::recv(c, part, sizeof part, 0)) > 0) {
      }
      count += n == 0 || errno == ECONNRESET ? 1 : 0;
    }
    return count;
  }

 private:
  std::vector<int> connections_;
  std::jthread thread_;
};

TEST_F(Served, FortySlowClientsKeepNobodyWaiting) {
  PageLimits patient;
  patient.request = std::chrono::minutes(10);
  const Limited server(place_, *engine_, patient);
  const Dripping slow(server, 40);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(server.status(), 200);
}

TEST_F(Served, SlowClientsAreDisconnectedToMakeRoom) {
  PageLimits strict;
  strict.request = std::chrono::milliseconds(200);
  strict.connections = 8;
  const Limited server(place_, *engine_, strict);
  const Dripping slow(server, 40);
  EXPECT_EQ(server.status(), 200);
  EXPECT_EQ(slow.let_go(), 40);
}

TEST_F(Served, ASlowReaderGetsALargeProductWholeAndASilentOneIsDisconnected) {
  const std::string large(20'000'000, 'x');
  std::ofstream(place_ / "plan.svg") << large;
  for (const bool reads : {true, false}) {
    PageLimits limits;
    if (!reads) limits.answer = std::chrono::milliseconds(200);
    const Limited server(place_, *engine_, limits);
    const int slow = server.connection();
    const std::string ask = fmt::format(
        "GET /plan.svg HTTP/1.1\r\nHost: localhost:{}\r\nConnection: close\r\n\r\n", server.port());
    ASSERT_EQ(::send(slow, ask.data(), ask.size(), MSG_NOSIGNAL), static_cast<ssize_t>(ask.size()));
    if (!reads) std::this_thread::sleep_for(std::chrono::seconds(1));
    std::string back;
    std::vector<char> part(400'000);
    for (ssize_t n = 0; (n = ::recv(slow, part.data(), part.size(), 0)) > 0;) {
      back.append(part.data(), static_cast<std::size_t>(n));
      if (reads) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ::close(slow);
    EXPECT_EQ(back.ends_with(large), reads);
  }
}

TEST_F(Served, SilentClientsAreDisconnected) {
  PageLimits strict;
  strict.idle = std::chrono::milliseconds(100);
  const Limited server(place_, *engine_, strict);
  const int silent = server.connection();
  char byte = 0;
  EXPECT_EQ(::recv(silent, &byte, 1, 0), 0);
  ::close(silent);
}

TEST_F(Served, StoppingWaitsForNoClient) {
  PageLimits patient;
  patient.request = patient.idle = std::chrono::hours(1);
  auto server = std::make_unique<Limited>(place_, *engine_, patient);
  const Dripping slow(*server, 3);
  const int silent = server->connection();
  EXPECT_EQ(server->status(), 200);
  server.reset();  // with all of them there
  ::close(silent);
}

TEST_F(Served, AnswersStayTheSameWhenTheCertificateIsTruncatedMeanwhile) {
  const std::string question = "/api/state?x=70&y=20&h=0.5";
  const json before = answer(question, 200);
  fs::resize_file(place_ / "certificate.safetensors", 100);
  fs::resize_file(place_ / "plan.safetensors", 100);
  EXPECT_EQ(answer(question, 200), before);
  EXPECT_FALSE(before["verdict"].is_null());
}

/// A run's folder with a plan that carries a contract; not proved as long as nobody asks.
class UnderContract : public ::testing::Test {
 protected:
  void SetUp() override {
    plan_.record.contract = contract();
    place_ = fs::path(folder_.file(""));
    write_plan(plan_, place_ / "plan.safetensors", Existing::keep);
  }
  static VehicleContract contract() {
    VehicleContract kept = VehicleContract::of(island().vehicle);
    kept.command_error_m = 2.0;
    kept.heading_error_rad = 0.05;
    kept.turn_radius_m = {8.0, 10.0};
    return kept;
  }
  static ContractCertificate certificate_under(const VehicleContract& kept) {
    ContractVerifyOptions options;
    options.find_witnesses = false;
    options.samples = 1000;
    return verify_contract(island(), "test", {}, kept, options, [](const std::string&) {})
        .certificate;
  }
  static const ContractCertificate& certificate() {
    static const ContractCertificate made = certificate_under(contract());
    return made;
  }
  fs::path write(const ContractCertificate& made, const std::string& name) const {
    write_contract_certificate(made, place_ / name, Existing::replace);
    return place_ / name;
  }
  std::string refusal(const fs::path& given = {}) const {
    try {
      const LiveEngine engine(place_, {}, given);
    } catch (const InputError& error) {
      return error.where() + ": " + error.what();
    }
    return "none";
  }

  const ScratchFolder folder_;
  fs::path place_;
  Plan plan_ = island();
};

TEST_F(UnderContract, StatesGetTheRepliesOfAQueryBesideTheExactAnswer) {
  const LiveEngine without(place_);
  EXPECT_TRUE(without.info()["contract"].is_null());
  EXPECT_TRUE(without.state({{20.0, 30.0}, Heading()})["contract"].is_null());

  write(certificate(), "contract.certificate.safetensors");
  const LiveEngine engine(place_);
  EXPECT_EQ(engine.info()["contract"]["command_error_m"], 2.0);
  Random random = Random::stream(9, 0);
  std::vector<State> states{{{1e300, 0.0}, Heading()}, {{-9.0, 50.0}, Heading()}};
  for (int k = 0; k < 300; ++k) {
    states.push_back({{random.uniform(-8.0, 111.9), random.uniform(4.0, 99.9)},
                      Heading::from_rad(random.uniform(-3.0, 3.0))});
  }
  const std::vector<ContractReply> replies = ask(certificate(), states);
  int reached = 0;
  int at_risk = 0;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const json whole = engine.state(states[k]);
    const json& found = whole["contract"];
    EXPECT_TRUE(whole.contains("flight"));
    EXPECT_EQ(found["verdict"], replies[k].word());
    EXPECT_EQ(found["time_bound_s"].is_null(), replies[k].verdict != Verdict::reach);
    EXPECT_EQ(found["witness"].is_null(), !replies[k].witness.has_value());
    if (replies[k].verdict == Verdict::reach) {
      ++reached;
      EXPECT_EQ(found["time_bound_s"], replies[k].time_bound_s);
    }
    if (!replies[k].witness) continue;
    ++at_risk;
    const json& steps = found["witness"]["steps"];
    ASSERT_EQ(steps.size(), replies[k].witness->steps.size());
    EXPECT_EQ(steps[0][0], states[k].position_m.x);
    EXPECT_EQ(steps[0][2], states[k].heading.rad());
    EXPECT_EQ(steps[0].size(), 8U);
    const std::string end = found["witness"]["end"];
    EXPECT_TRUE(end == "collide" || end == "leave");
    EXPECT_GT(found["witness"]["time_s"].get<double>(), 0.0);
  }
  EXPECT_GT(reached, 10);
  EXPECT_GT(at_risk, 5);
}

TEST_F(UnderContract, ACertificateGivenIsUsedInsteadOfTheRunsOwn) {
  const fs::path given = write(certificate(), "other.safetensors");
  std::ofstream(place_ / "contract.certificate.safetensors") << "broken";
  EXPECT_NE(refusal().find("contract.certificate.safetensors"), std::string::npos);
  EXPECT_EQ(refusal(given), "none");
  EXPECT_NE(refusal(place_ / "missing.safetensors").find("missing.safetensors"), std::string::npos);
  EXPECT_NE(refusal(place_ / "plan.safetensors").find("is a plan"), std::string::npos);
}

TEST_F(UnderContract, RefusesACertificateOfAnotherPlanOrVehicleOrContractAndSaysWhich) {
  const fs::path given = write(certificate(), "other.safetensors");
  VehicleContract wider = contract();
  wider.command_error_m = 2.5;
  const std::string other = refusal(write(certificate_under(wider), "wider.safetensors"));
  EXPECT_NE(other.find("another contract"), std::string::npos) << other;
  EXPECT_NE(other.find("command_error_m is 2.5, the plan's is 2.0"), std::string::npos) << other;
  EXPECT_EQ(other.find("heading_error_rad"), std::string::npos) << other;

  Plan changed = plan_;
  changed.record.contract.reset();  // then any contract will do
  write_plan(changed, place_ / "plan.safetensors", Existing::replace);
  EXPECT_EQ(refusal(given), "none");
  changed.vehicle.turn_radius_m += 0.5;
  write_plan(changed, place_ / "plan.safetensors", Existing::replace);
  EXPECT_NE(refusal(given).find("different plan or vehicle"), std::string::npos);
  changed.vehicle = plan_.vehicle;
  changed.cost_m[0] += 1.0F;
  write_plan(changed, place_ / "plan.safetensors", Existing::replace);
  EXPECT_NE(refusal(given).find("different plan or vehicle"), std::string::npos);
}

TEST(LiveEngine, RefusesACertificateOfAnotherPlan) {
  const ScratchFolder folder;
  const fs::path place(folder.file(""));
  Plan plan = island();
  write_certificate(certificate_of(plan), place / "certificate.safetensors", Existing::keep);
  plan.cost_m[0] += 1.0F;
  write_plan(plan, place / "plan.safetensors", Existing::keep);
  EXPECT_THROW(LiveEngine{place}, InputError);
}

TEST(LiveEngine, RefusesTheCertificateOfAnotherVehicle) {
  for (const bool radius : {false, true}) {
    const ScratchFolder folder;
    const fs::path place(folder.file(""));
    Plan plan = island();
    write_certificate(certificate_of(plan), place / "certificate.safetensors", Existing::keep);
    (radius ? plan.vehicle.turn_radius_m : plan.vehicle.speed_mps) *= 1.5;  // the same arrays
    write_plan(plan, place / "plan.safetensors", Existing::keep);
    EXPECT_THROW(LiveEngine{place}, InputError);
  }
}

TEST(LiveEngine, GivesFlightsWithoutVerdictsWhereNothingWasProved) {
  const ScratchFolder folder;
  const fs::path place(folder.file(""));
  Plan plan = island();
  plan.record.mission = GoalMission{{80.0, 60.0}, 0.5};
  write_plan(plan, place / "plan.safetensors", Existing::keep);
  const LiveEngine engine(place);
  EXPECT_EQ(engine.info()["verdicts"], false);
  const json found = engine.state({{70.0, 60.0}, Heading::from_rad(0.0)});
  EXPECT_TRUE(found["verdict"].is_null());
  EXPECT_EQ(found["flight"]["outcome"], "reach");
  EXPECT_TRUE(found["flight"].contains("leg"));  // to the heading of the goal
}

TEST(LiveEngine, RefusesAPlanWithoutAMission) {
  const ScratchFolder folder;
  const fs::path place(folder.file(""));
  Plan plan = island();
  plan.record.mission.reset();
  write_plan(plan, place / "plan.safetensors", Existing::keep);
  EXPECT_THROW(LiveEngine{place}, InputError);
}

}  // namespace
}  // namespace fairway
