#include "commands/teaching/result_sending.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "commands/support/cli_support.h"
#include "exercises/result_files.h"
#include "osteon/base/file.h"
#include "osteon/results/lrs.h"

namespace osteon {
namespace {

struct SendCommand {
  Lrs lrs;
  AttemptFilter filter;
  std::string password_file, certificates, to;
  double timeout_s = 20;
  bool json = false;
};

// From a file or the environment: what stands on a command line is seen by every user.
Result<std::string> password_of(const SendCommand& command) {
  if (command.password_file.empty()) {
    const char* given = std::getenv("OSTEON_LRS_PASSWORD");
    return std::string(given ? given : "");
  }
  auto text = read_file(command.password_file, 4096);
  if (!text) return text;
  while (!text->empty() && (text->back() == '\n' || text->back() == '\r')) text->pop_back();
  return text;
}

std::string sent_json(const Lrs& lrs, const SentReport& report) {
  auto refusals = nlohmann::ordered_json::array();
  for (const Sending& one : report.refusals)
    refusals.push_back({{"id", one.id}, {"why", one.refusal}});
  nlohmann::ordered_json json = {{"endpoint", lrs.endpoint},
                                 {"accepted", report.accepted},
                                 {"refused", report.refused},
                                 {"waiting", report.waiting},
                                 {"refusals", refusals}};
  json["why_waiting"] = report.why_waiting ? nlohmann::ordered_json(report.why_waiting->message())
                                           : nlohmann::ordered_json(nullptr);
  return json.dump(2);
}

void print_sent(const SentReport& report) {
  std::printf("%zu accepted, %zu refused, %zu waiting\n", report.accepted, report.refused,
              report.waiting);
  for (const Sending& one : report.refusals)
    std::printf("refused %s: %s\n", one.id.c_str(), one.refusal.c_str());
  if (report.why_waiting)
    std::fprintf(stderr, "osteon: %s\n", report.why_waiting->message().c_str());
}

int send_results(SendCommand command) {
  const auto password = password_of(command);
  if (!password) return report_error(password.error());
  command.lrs.password = *password;
  command.lrs.certificates = command.certificates;
  command.lrs.timeout_ms = static_cast<long>(command.timeout_s * 1000);
  while (command.lrs.endpoint.ends_with('/')) command.lrs.endpoint.pop_back();
  auto store = open_results();
  if (!store) return report_error(store.error());
  const auto rows = store->list(command.filter);
  if (!rows) return report_error(rows.error());
  const auto sent = send_to_lrs(command.lrs, *rows, *store, [](long ms) {
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
  });
  if (!sent) return report_error(sent.error());
  if (command.json)
    std::printf("%s\n", sent_json(command.lrs, *sent).c_str());
  else
    print_sent(*sent);
  return sent->waiting + sent->refused > 0 ? kExitNo : kExitDone;
}

int copy_results(const SendCommand& command) {
  const auto from = open_results();
  if (!from) return report_error(from.error());
  const auto rows = from->list(command.filter);
  if (!rows) return report_error(rows.error());
  auto to = ResultStore::open(command.to);
  if (!to) return report_error(to.error());
  std::size_t added = 0;
  for (const AttemptRow& row : *rows) {
    const auto one = to->add(row);
    if (!one) return report_error(one.error());
    added += *one ? 1 : 0;
  }
  std::printf("%zu attempts copied to %s, %zu already there\n", added,
              without_password(command.to).c_str(), rows->size() - added);
  return kExitDone;
}

void add_whose(cli::App& command, AttemptFilter& filter) {
  command.add_option("--learner", filter.learner, "only those of this learner");
  command.add_option("--scenario", filter.scenario, "only those of this scenario");
}

}  // namespace

void add_result_sending(cli::App& results, int& exit_code) {
  auto options = std::make_shared<SendCommand>();
  cli::App* send =
      results.add_subcommand("send", "Send new attempts to a learning record store (xAPI)");
  add_whose(*send, options->filter);
  send->add_option("--to", options->lrs.endpoint, "address of the store, https://HOST/PATH")
      ->required();
  send->add_option("--user", options->lrs.user, "user or key");
  send->add_option("--password-file", options->password_file,
                   "file that holds the password; default: OSTEON_LRS_PASSWORD");
  send->add_option("--certificates", options->certificates,
                   "PEM file of trusted certificate authorities; default: the system's");
  send->add_option("--home-page", options->lrs.home_page, "home page of the learners' accounts")
      ->capture_default_str();
  send->add_option("--timeout", options->timeout_s, "time limit of one request, s")
      ->check(cli::Range(0.1, 600.0))
      ->capture_default_str();
  send->add_flag("--json", options->json, "print JSON");
  send->callback([options, &exit_code] { exit_code = send_results(*options); });
  cli::App* copy = results.add_subcommand("copy", "Copy attempts to another results database");
  add_whose(*copy, options->filter);
  copy->add_option("--to", options->to, "a file, or postgresql://USER@HOST/DATABASE")->required();
  copy->callback([options, &exit_code] { exit_code = copy_results(*options); });
}

}  // namespace osteon
