#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/results/attempt_row.h"
#include "osteon/results/lrs.h"

namespace osteon {

/// What a learning management system (LMS) puts into the address that launches an exercise:
/// `osteon://launch/SCENARIO?endpoint=...&fetch=...&actor=...&registration=...&activityId=...`.
/// Source: cmi5 first edition (Quartz), 8.1.
struct Cmi5Launch {
  std::string scenario;               ///< name of a shipped one
  std::optional<std::uint64_t> seed;  ///< of the patient, `seed=` in the address
  std::string endpoint, fetch;        ///< of its record store; of the token, once
  std::string actor_json;             ///< the learner, an agent with an account
  std::string registration;           ///< UUID
  std::string activity;               ///< what the exercise is called there
};
/// Fails on an address that lacks a part, that names a file instead of an exercise, or whose token
/// or statements would go in the open to another computer.
Result<Cmi5Launch> parse_cmi5_launch(const std::string& url);

/// How requests to an LMS are made.
struct Cmi5Way {
  std::filesystem::path certificates = {};  ///< see Lrs
  long timeout_ms = 20000;                  ///< of one request
  Wait wait = {};                           ///< none: a busy record store is asked once
};

/// A launch that the LMS has opened: from its first statement to its last.
struct Cmi5Session {
  Cmi5Launch launch;
  std::string authorization;      ///< header of every request; a secret
  std::string context_json;       ///< what every statement's context begins with
  bool counts = true;             ///< false: only looked at, nothing is judged (Browse, Review)
  std::optional<double> mastery;  ///< least scaled score to pass, 0 to 1
  std::string return_url;         ///< where the learner goes on; empty: nowhere
  std::string learner;            ///< a local id made of the account: says nobody's name
  std::string account_name;
  std::int64_t began_ms = 0;
};
/// Fetches the token, then what the LMS left for this launch (its LMS.LaunchData and the learner's
/// preferences). The token is given out once: after an error the LMS has to launch again.
Result<Cmi5Session> begin_cmi5(const Cmi5Launch& launch, const Cmi5Way& way);

/// The session's first statement, a JSON array.
std::string cmi5_first_words(const Cmi5Session& session);
/// Its last ones, a JSON array: completed when the attempt did all stages, passed or failed with
/// the score as it was judged, terminated. None of them but the last without an attempt or where
/// nothing counts; neither passed nor failed when it is undecided. Where the LMS names a mastery
/// score, who passes must have it as well; a score that contradicts a failure is left out (9.5.1).
std::string cmi5_last_words(const Cmi5Session& session, const std::optional<AttemptRow>& attempt,
                            std::int64_t ended_ms);

/// Writes statements into `folder` before they are sent, which only its owner may read: it holds
/// the launch's token. `part` orders those of one session.
Result<void> queue_cmi5(const Cmi5Session& session, const std::string& statements, int part,
                        const std::filesystem::path& folder);

/// What became of statements that were queued.
struct Cmi5Sent {
  std::size_t accepted = 0;  ///< or known there before: one completed and one passed a registration
  std::size_t waiting = 0;
  std::vector<std::string> refusals;  ///< of this time; kept beside the queue as *.refused
  std::optional<Error> why_waiting;
};
/// Sends all that is queued, each session in its order, and removes what has arrived. Safe to
/// repeat: statements keep their ids. With `only` what other sessions left stays where it is. Fails
/// only where the folder cannot be read or written.
Result<Cmi5Sent> send_cmi5(const std::filesystem::path& folder, const Cmi5Way& way,
                           const Cmi5Session* only = nullptr);

}  // namespace osteon
