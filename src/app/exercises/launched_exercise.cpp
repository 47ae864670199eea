#include "exercises/launched_exercise.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "cases/xdg.h"
#include "exercises/result_files.h"
#include "osteon/results/names.h"

namespace osteon {
namespace {

std::int64_t utc_ms_now() {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(since).count();
}

// Who the learner's id stands for is kept on this computer alone.
Result<void> remember_account(const Cmi5Session& session) {
  auto names = load_names(names_file());
  if (!names) return tl::unexpected(names.error());
  if (!names->emplace(session.learner, session.account_name).second) return {};
  return save_names(*names, names_file());
}

void add_sent(Cmi5Sent& sum, Cmi5Sent more) {
  sum.accepted += more.accepted;
  sum.waiting = more.waiting;
  for (std::string& refusal : more.refusals) sum.refusals.push_back(std::move(refusal));
  sum.why_waiting = std::move(more.why_waiting);
}

}  // namespace

std::filesystem::path launches_folder() { return data_home_dir() / "launches"; }

Result<LaunchedExercise> run_launched(const Cmi5Launch& launch, const Cmi5Way& way,
                                      const PlayLaunched& play) {
  const auto session = begin_cmi5(launch, way);
  if (!session) return tl::unexpected(session.error());
  if (auto ok = remember_account(*session); !ok) return tl::unexpected(ok.error());
  LaunchedExercise done;
  done.counts = session->counts;
  done.return_url = session->return_url;
  // At the start a learner waits: what others left is sent at the end.
  const auto tell = [&](const std::string& statements, int part) -> Result<void> {
    if (auto ok = queue_cmi5(*session, statements, part, launches_folder()); !ok) return ok;
    auto sent = send_cmi5(launches_folder(), way, part == 1 ? &*session : nullptr);
    if (!sent) {
      done.sent.why_waiting = sent.error();
      done.sent.waiting = std::max<std::size_t>(1, done.sent.waiting);
      return {};
    }
    add_sent(done.sent, std::move(*sent));
    return {};
  };
  if (auto ok = tell(cmi5_first_words(*session), 1); !ok) return tl::unexpected(ok.error());
  auto attempt = play(launch, session->learner);
  if (attempt)
    done.attempt = std::move(*attempt);
  else
    done.not_played = attempt.error();
  if (auto ok = tell(cmi5_last_words(*session, done.attempt, utc_ms_now()), 2); !ok)
    return tl::unexpected(ok.error());
  return done;
}

}  // namespace osteon
