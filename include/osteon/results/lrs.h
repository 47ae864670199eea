#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/results/store.h"

namespace osteon {

/// A learning record store: where xAPI statements are sent to.
struct Lrs {
  std::string endpoint;            ///< "https://lrs.example.org/xapi": "/statements" is added
  std::string user, password;      ///< HTTP basic authentication; without a user there is none
  std::string authorization = {};  ///< in place of both: the header's value, as it was given
  std::filesystem::path certificates = {};     ///< PEM file to trust beside none other; empty: the
                                               ///< system's
  std::string home_page = "urn:osteon:local";  ///< of the learners' accounts
  long timeout_ms = 20000;                     ///< of one request
  std::size_t batch = 50;                      ///< statements in one request
};

/// What became of the attempts that were to be sent.
struct SentReport {
  std::size_t accepted = 0, refused = 0, waiting = 0;
  std::vector<Sending> refusals;  ///< of this time
  std::optional<Error> why_waiting;
};

/// How the client waits before it asks again: milliseconds. A test needs not wait.
using Wait = std::function<void(long)>;

/// Sends the statements of `rows` that `store` does not know to be accepted or refused by this
/// endpoint, and marks each there when the record store has said so. Safe to repeat at any time: a
/// statement's id is the attempt's, and what was taken is never taken twice. A refused batch is
/// halved until the statement at fault is alone; that one is marked refused, with the answer. Of a
/// record store that is away, stalls, or asks to wait longer than it is waited for, the rest stays
/// waiting. An answer that does not name what was sent is not believed: each statement is asked
/// for. Fails only where `store` fails, the endpoint is no http or https address, or a password
/// would be sent in the open to another computer.
/// Source: xAPI 1.0.3, part three, 2.1 (statement resource) and 3.2 (error codes).
Result<SentReport> send_to_lrs(const Lrs& lrs, const std::vector<AttemptRow>& rows,
                               ResultStore& store, const Wait& wait);

}  // namespace osteon
