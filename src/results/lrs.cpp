#include "osteon/results/lrs.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <utility>

#include "osteon/results/exports.h"
#include "patient_http.h"

namespace osteon {
namespace {

using LrsJson = nlohmann::json;
using Rows = std::span<const AttemptRow>;

// These speak of who sends and where to: no statement is at fault.
bool speaks_of_the_way(long status) {
  return status < 200 || (status >= 300 && status < 400) || status == 401 || status == 402 ||
         status == 403 || status == 404 || status == 405 || status == 407;
}

// One sending.
//   todo     statements that no word is known of, a batch at a time
//   halves   of a batch that was refused whole: smaller ones, until one statement is alone
// Invariant: a statement is marked only after the record store named its id as taken, showed it
// when asked for it, or refused it alone. It ends: a batch is either settled, cut in two, or ends
// the sending; halving ends at one.
class Sender {
 public:
  Sender(const Lrs& lrs, LrsHttp http, ResultStore& store, const Wait& wait)
      : lrs_(lrs), http_(std::move(http)), store_(store), wait_(wait) {}

  Result<void> send(Rows rows) {
    for (std::size_t begin = 0; begin < rows.size(); begin += lrs_.batch) {
      const Rows batch = rows.subspan(begin, std::min(lrs_.batch, rows.size() - begin));
      if (auto sent = send_batch(batch); !sent) return sent;
      if (report.why_waiting) break;
    }
    return {};
  }
  SentReport report;

 private:
  Result<void> send_batch(Rows rows) {
    if (report.why_waiting || rows.empty()) return {};
    const auto answer = asked([&] { return http_.post("/statements", statements(rows)); });
    if (!answer) return {};
    if (answer->status == 200 || answer->status == 204) return taken(rows, *answer);
    if (speaks_of_the_way(answer->status)) {
      report.why_waiting = way_refused(*answer);
      return {};
    }
    if (rows.size() > 1) {
      if (auto first = send_batch(rows.first(rows.size() / 2)); !first) return first;
      return send_batch(rows.subspan(rows.size() / 2));
    }
    return refused(rows[0], *answer);
  }

  std::string statements(Rows rows) const {
    return to_xapi(std::vector<AttemptRow>(rows.begin(), rows.end()), lrs_.home_page);
  }

  // Nothing where the rest must wait.
  template <class Ask>
  std::optional<HttpAnswer> asked(Ask ask) {
    auto answer = asked_patiently(ask, wait_, lrs_.endpoint);
    if (answer) return std::move(*answer);
    report.why_waiting = answer.error();
    return std::nullopt;
  }

  Error way_refused(const HttpAnswer& answer) const {
    const bool user = answer.status == 401 || answer.status == 403;
    return {"the record store refused the request (HTTP " + std::to_string(answer.status) + ": " +
                first_words(answer.body) + ")",
            lrs_.endpoint,
            user ? "Check --user and the password"
                 : "Check the address: xAPI's path, without /statements"};
  }

  // 200 with the ids of all: taken. With anything else each is asked for.
  Result<void> taken(Rows rows, const HttpAnswer& answer) {
    const std::set<std::string> named = ids_in(answer.body);
    for (const AttemptRow& row : rows) {
      if (report.why_waiting) return {};
      bool there = named.count(row.id) > 0;
      if (!there) {
        const auto shown = has(row);
        if (!shown) return {};
        there = *shown;
      }
      if (!there) {
        report.why_waiting = Error{"the record store accepted an attempt but does not have it",
                                   lrs_.endpoint, "Tell its administrator; the attempt waits"};
        return {};
      }
      if (auto ok = accept(row); !ok) return ok;
    }
    return {};
  }
  static std::set<std::string> ids_in(const std::string& body) {
    std::set<std::string> ids;
    const LrsJson list = LrsJson::parse(body, nullptr, false);
    if (!list.is_array()) return ids;
    for (const LrsJson& id : list)
      if (id.is_string()) ids.insert(id.get<std::string>());
    return ids;
  }

  // Whether the record store shows this very statement. Nothing where the rest must wait.
  std::optional<bool> has(const AttemptRow& row) {
    const auto answer = asked([&] { return http_.get("/statements?statementId=" + row.id); });
    if (!answer) return std::nullopt;
    if (answer->status != 200) return false;
    const LrsJson there = LrsJson::parse(answer->body, nullptr, false);
    const LrsJson mine = LrsJson::parse(to_xapi({row}, lrs_.home_page))[0];
    if (!there.is_object()) return false;
    for (const char* key : {"id", "actor", "verb", "object"})
      if (!there.contains(key)) return false;
    return there["id"] == mine["id"] && there["verb"].value("id", "") == mine["verb"]["id"] &&
           there["object"].value("id", "") == mine["object"]["id"] &&
           there["actor"].value("account", LrsJson()) == mine["actor"]["account"];
  }

  // Alone and refused. 409: the id is there already, perhaps from a sending whose answer was lost.
  Result<void> refused(const AttemptRow& row, const HttpAnswer& answer) {
    if (answer.status == 409) {
      const auto there = has(row);
      if (!there) return {};
      if (*there) return accept(row);
    }
    Sending word{row.id, lrs_.endpoint,
                 "HTTP " + std::to_string(answer.status) + ": " + first_words(answer.body)};
    if (auto ok = store_.mark(word); !ok) return ok;
    ++report.refused;
    report.refusals.push_back(std::move(word));
    return {};
  }
  Result<void> accept(const AttemptRow& row) {
    if (auto ok = store_.mark({row.id, lrs_.endpoint, ""}); !ok) return ok;
    ++report.accepted;
    return {};
  }

  const Lrs& lrs_;
  LrsHttp http_;
  ResultStore& store_;
  const Wait& wait_;
};

}  // namespace

Result<SentReport> send_to_lrs(const Lrs& lrs, const std::vector<AttemptRow>& rows,
                               ResultStore& store, const Wait& wait) {
  auto http = LrsHttp::to(lrs);
  if (!http) return tl::unexpected(http.error());
  const auto known = store.sendings(lrs.endpoint);
  if (!known) return tl::unexpected(known.error());
  std::set<std::string> settled;
  for (const Sending& one : *known) settled.insert(one.id);
  std::vector<AttemptRow> unsent;
  for (const AttemptRow& row : rows)
    if (!settled.count(row.id)) unsent.push_back(row);
  Sender sender(lrs, std::move(*http), store, wait);
  if (auto sent = sender.send(unsent); !sent) return tl::unexpected(sent.error());
  sender.report.waiting = unsent.size() - sender.report.accepted - sender.report.refused;
  return std::move(sender.report);
}

}  // namespace osteon
