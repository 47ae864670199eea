#include <cmath>
#include <pqxx/pqxx>
#include <sstream>
#include <utility>

#include "backend.h"

namespace osteon {
namespace {

constexpr int kServerFormat = 1;
// One seat at a time makes the tables; the number is the name of this lock.
constexpr const char* kLock = "SELECT pg_advisory_xact_lock(1330859602)";
constexpr const char* kTables =
    "CREATE TABLE IF NOT EXISTS osteon_format(version INTEGER NOT NULL);"
    "CREATE TABLE IF NOT EXISTS osteon_attempts("
    "seq BIGSERIAL PRIMARY KEY, id TEXT NOT NULL UNIQUE, learner TEXT NOT NULL,"
    "scenario TEXT NOT NULL, scenario_version INTEGER NOT NULL, standard_version INTEGER NOT NULL,"
    "verdict TEXT NOT NULL, score DOUBLE PRECISION, score_lo DOUBLE PRECISION,"
    "score_hi DOUBLE PRECISION, ended_ms BIGINT NOT NULL, duration_s DOUBLE PRECISION NOT NULL,"
    "case_name TEXT NOT NULL, state_hash TEXT NOT NULL, report TEXT NOT NULL);"
    "CREATE INDEX IF NOT EXISTS osteon_attempts_learner ON osteon_attempts(learner, scenario);"
    "CREATE TABLE IF NOT EXISTS osteon_sendings(id TEXT NOT NULL, endpoint TEXT NOT NULL,"
    "refusal TEXT NOT NULL, PRIMARY KEY(id, endpoint));";
constexpr const char* kServerColumns =
    "id, learner, scenario, scenario_version, standard_version, verdict, score, score_lo, "
    "score_hi, ended_ms, duration_s, case_name, state_hash, report";

std::optional<double> number_or_none(const pqxx::field& field) {
  if (field.is_null()) return std::nullopt;
  return field.as<double>();
}

AttemptRow row_of_server(const pqxx::row& r) {
  AttemptRow row;
  row.id = r[0].as<std::string>();
  row.learner = r[1].as<std::string>();
  row.scenario = r[2].as<std::string>();
  row.scenario_version = r[3].as<int>();
  row.standard_version = r[4].as<int>();
  row.verdict = r[5].as<std::string>();
  row.score = number_or_none(r[6]);
  row.score_lo = number_or_none(r[7]);
  row.score_hi = number_or_none(r[8]);
  row.ended_ms = r[9].as<std::int64_t>();
  row.duration_s = r[10].as<double>();
  row.case_name = r[11].as<std::string>();
  row.state_hash = r[12].as<std::string>();
  row.report_json = r[13].as<std::string>();
  return row;
}

// A number or NULL as the server reads it, every digit kept.
std::string sql_number(const std::optional<double>& value) {
  if (!value || !std::isfinite(*value)) return "NULL";
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << *value;
  return text.str();
}

// A server that is gone is noticed: while connecting, and on a line that went dead.
std::string with_time_limits(const std::string& url) {
  std::string all = url;
  for (const char* limit : {"connect_timeout=10", "tcp_user_timeout=20000"}) {
    const std::string name = std::string(limit, std::string(limit).find('=') + 1);
    if (all.find(name) == std::string::npos)
      all += (all.find('?') == std::string::npos ? "?" : "&") + std::string(limit);
  }
  return all;
}

/// One connection, made anew when it broke. Every call is one transaction.
class PostgresStore final : public ResultBackend {
 public:
  PostgresStore(std::string url, double wait_s) : url_(std::move(url)), wait_s_(wait_s) {}

  Result<void> make() {
    return guarded([&]() -> Result<void> {
      pqxx::work work(connection());
      work.exec(kLock);
      work.exec(kTables);
      const pqxx::result version = work.exec("SELECT version FROM osteon_format");
      if (version.empty())
        work.exec("INSERT INTO osteon_format VALUES(" + std::to_string(kServerFormat) + ")");
      else if (version[0][0].as<int>() > kServerFormat)
        return fail("belongs to a newer Osteon", shown(), "Use that version, or another database");
      work.commit();
      return {};
    });
  }

  Result<bool> add(const AttemptRow& row) override {
    return guarded([&]() -> Result<bool> {
      pqxx::work work(connection());
      const pqxx::result in =
          work.exec(std::string("INSERT INTO osteon_attempts(") + kServerColumns + ") VALUES(" +
                    values(work, row) + ") ON CONFLICT (id) DO NOTHING");
      const bool added = in.affected_rows() == 1;
      if (!added && found(work, row.id) != row)
        return fail("another attempt has the id " + row.id, shown(),
                    "An attempt is written once and never changed");
      work.commit();
      return added;
    });
  }

  Result<std::vector<AttemptRow>> list(const AttemptFilter& filter) override {
    return guarded([&]() -> Result<std::vector<AttemptRow>> {
      pqxx::work work(connection());
      std::string where = "TRUE";
      if (!filter.learner.empty()) where += " AND learner=" + work.quote(filter.learner);
      if (!filter.scenario.empty()) where += " AND scenario=" + work.quote(filter.scenario);
      std::vector<AttemptRow> rows;
      for (const pqxx::row& r : work.exec(std::string("SELECT ") + kServerColumns +
                                          " FROM osteon_attempts WHERE " + where + " ORDER BY seq"))
        rows.push_back(row_of_server(r));
      return rows;
    });
  }

  Result<std::optional<AttemptRow>> find(const std::string& id) override {
    return guarded([&]() -> Result<std::optional<AttemptRow>> {
      pqxx::work work(connection());
      return found(work, id);
    });
  }

  Result<int> forget(const std::string& learner) override {
    return guarded([&]() -> Result<int> {
      int gone = 0;
      {
        pqxx::work work(connection());
        const std::string whose = work.quote(learner);
        work.exec(
            "DELETE FROM osteon_sendings WHERE id IN (SELECT id FROM osteon_attempts WHERE "
            "learner=" +
            whose + ")");
        gone = static_cast<int>(
            work.exec("DELETE FROM osteon_attempts WHERE learner=" + whose).affected_rows());
        work.commit();
      }
      // The table is written anew, without what the deleted rows left in its pages.
      pqxx::nontransaction outside(connection());
      outside.exec("VACUUM FULL osteon_attempts");
      return gone;
    });
  }

  Result<void> mark(const Sending& sending) override {
    return guarded([&]() -> Result<void> {
      pqxx::work work(connection());
      work.exec("INSERT INTO osteon_sendings VALUES(" + work.quote(sending.id) + "," +
                work.quote(sending.endpoint) + "," + work.quote(sending.refusal) +
                ") ON CONFLICT (id, endpoint) DO UPDATE SET refusal=EXCLUDED.refusal");
      work.commit();
      return {};
    });
  }

  Result<std::vector<Sending>> sendings(const std::string& endpoint) override {
    return guarded([&]() -> Result<std::vector<Sending>> {
      pqxx::work work(connection());
      std::vector<Sending> all;
      for (const pqxx::row& r :
           work.exec("SELECT id, endpoint, refusal FROM osteon_sendings WHERE endpoint=" +
                     work.quote(endpoint) + " ORDER BY id"))
        all.push_back({r[0].as<std::string>(), r[1].as<std::string>(), r[2].as<std::string>()});
      return all;
    });
  }

 private:
  std::string shown() const { return without_password(url_); }

  pqxx::connection& connection() {
    if (!connection_) {
      connection_ = std::make_unique<pqxx::connection>(with_time_limits(url_));
      connection_->set_variable("statement_timeout",
                                std::to_string(static_cast<long>(wait_s_ * 1000)));
      connection_->set_client_encoding("UTF8");
    }
    return *connection_;
  }

  static std::optional<AttemptRow> found(pqxx::work& work, const std::string& id) {
    const pqxx::result r = work.exec(std::string("SELECT ") + kServerColumns +
                                     " FROM osteon_attempts WHERE id=" + work.quote(id));
    if (r.empty()) return std::nullopt;
    return row_of_server(r[0]);
  }

  static std::string values(pqxx::work& work, const AttemptRow& row) {
    const auto q = [&](const std::string& text) { return work.quote(text) + ","; };
    return q(row.id) + q(row.learner) + q(row.scenario) + std::to_string(row.scenario_version) +
           "," + std::to_string(row.standard_version) + "," + q(row.verdict) +
           sql_number(row.score) + "," + sql_number(row.score_lo) + "," + sql_number(row.score_hi) +
           "," + std::to_string(row.ended_ms) + "," + sql_number(row.duration_s) + "," +
           q(row.case_name) + q(row.state_hash) + work.quote(row.report_json);
  }

  // Runs `work`; what libpqxx throws becomes an error. After any, the connection is made anew.
  template <class Work>
  auto guarded(Work work) -> decltype(work()) {
    try {
      return work();
    } catch (const pqxx::in_doubt_error&) {
      connection_.reset();
      return fail("the connection to the server was lost during writing", shown(),
                  "Send the attempt again: it is stored only once");
    } catch (const pqxx::broken_connection& e) {
      connection_.reset();
      return fail("the results server does not answer (" + first_line(e.what()) + ")", shown(),
                  "Check that it is running, and check address, user and password");
    } catch (const std::exception& e) {
      connection_.reset();
      return fail("the results server refused (" + first_line(e.what()) + ")", shown(),
                  "Check the user's rights on the database; nothing was changed");
    }
  }
  static std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

  std::string url_;
  double wait_s_;
  std::unique_ptr<pqxx::connection> connection_;
};

}  // namespace

Result<std::unique_ptr<ResultBackend>> open_postgres(const std::string& url, double wait_s) {
  auto store = std::make_unique<PostgresStore>(url, wait_s);
  if (auto made = store->make(); !made) return tl::unexpected(made.error());
  return std::unique_ptr<ResultBackend>(std::move(store));
}

}  // namespace osteon
