#include "exercises/ghost/ghost_recording.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "cases/xdg.h"
#include "exercises/debrief.h"
#include "exercises/ghost/ghost_file.h"
#include "exercises/result_files.h"
#include "osteon/base/file.h"
#include "osteon/base/hash.h"
#include "osteon/record/recording.h"
#include "osteon/record/recording_note.h"
#include "osteon/session/session.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

Result<RecordingHeader> header_for_ghost(const fs::path& recording, const GhostWanted& wanted) {
  auto reader = RecordingReader::open(recording);
  if (!reader) return tl::unexpected(reader.error());
  const auto note = read_note(recording, "scenario");
  if (!note) return tl::unexpected(note.error());
  const std::string record_again =
      "Record one with: osteon run " + wanted.scenario.name + " --surgeon expert --record FILE.osr";
  if (!*note) return fail("the recording contains no exercise", recording.string(), record_again);
  const auto scenario = parse_scenario(**note, recording.string() + " (its exercise)");
  if (!scenario) return tl::unexpected(scenario.error());
  if (scenario->name != wanted.scenario.name)
    return fail("the recording is of the exercise '" + scenario->name + "', not of '" +
                    wanted.scenario.name + "'",
                recording.string(), record_again);
  if (reader->header().case_hash != wanted.case_hash)
    return fail("the recording is of another patient, '" + reader->header().case_source + "'",
                recording.string(), record_again + " and --case '" + wanted.case_spec + "'");
  return reader->header();
}

// A program that gives way to the window's loops, without input and output.
Result<pid_t> start_quietly(std::vector<std::string> text) {
  text.insert(text.begin(), {"nice", "-n", "10"});
  std::vector<char*> words;
  for (std::string& word : text) words.push_back(word.data());
  words.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDWR, 0);
  posix_spawn_file_actions_adddup2(&files, 0, 1);
  posix_spawn_file_actions_adddup2(&files, 0, 2);
  posix_spawn_file_actions_addclosefrom_np(&files, 3);
  pid_t child = 0;
  const int failed = ::posix_spawnp(&child, "nice", &files, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (failed != 0)
    return fail("the program for the expert's run could not be started: " +
                std::generic_category().message(failed));
  return child;
}

// Its exit code; none: it was ended, by `go_on` or from outside.
std::optional<int> wait_for_program(pid_t child, const std::function<bool()>& go_on) {
  for (bool asked = false;;) {
    int status = 0;
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child)
      return !asked && WIFEXITED(status) ? std::optional<int>(WEXITSTATUS(status)) : std::nullopt;
    if (ended < 0 && errno != EINTR) return std::nullopt;
    if (!asked && !go_on()) {
      asked = true;
      ::kill(child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

fs::path kept_way(const fs::path& recording) { return recording.string() + ".way"; }

constexpr int kNotPassed = 1;  // exit codes up to this one: the exercise was played to its end

Result<void> record_expert(const GhostWanted& wanted, const fs::path& file,
                           const std::function<bool()>& go_on, fs::path program) {
  std::error_code ec;
  if (program.empty()) program = fs::read_symlink("/proc/self/exe", ec);
  if (ec) return fail("the program's own file was not found: " + ec.message());
  fs::create_directories(file.parent_path(), ec);
  if (ec) return fail("the folder could not be made: " + ec.message(), file.parent_path().string());
  // Two windows may record the same expert at a time; the name is only given to a whole recording.
  const std::string part = file.string() + "." + std::to_string(::getpid()) + ".part";
  const std::string exercise = part + ".toml", graft = part + ".json", way = kept_way(part);
  const auto remove_parts = [&] {
    for (const char* end : {"", "-wal", "-shm", ".toml", ".json", ".way"})
      fs::remove(part + end, ec);
  };
  remove_parts();
  if (auto ok = write_file_atomic(exercise, wanted.scenario.source_text); !ok) return ok;
  std::vector<std::string> words{program.string(), "run",       exercise, "--case",
                                 wanted.case_spec, "--surgeon", "expert", "--no-store"};
  if (!wanted.graft_json.empty()) {
    if (auto ok = write_file_atomic(graft, wanted.graft_json); !ok) {
      remove_parts();
      return ok;
    }
    words.insert(words.end(), {"--graft", graft});
  }
  if (!wanted.to_stage.empty()) words.insert(words.end(), {"--to-stage", wanted.to_stage});
  words.insert(words.end(), {"--way", way, "--record", part});
  const auto child = start_quietly(std::move(words));
  if (!child) {
    remove_parts();
    return tl::unexpected(child.error());
  }
  const auto code = wait_for_program(*child, go_on);
  const bool played = code && *code <= kNotPassed;
  if (played) fs::rename(part, file, ec);
  const bool kept = played && !ec;
  // Whose way could not be kept is repeated.
  std::error_code no_way;
  if (kept) fs::rename(way, kept_way(file), no_way);
  remove_parts();
  if (kept) return {};
  return fail("the virtual expert could not perform the exercise on this patient", wanted.case_spec,
              "See why: osteon run " + wanted.scenario.name + " --case '" + wanted.case_spec + "'");
}

struct RepeatedGhost {
  GhostTrack track;
  Verdict verdict = Verdict::kUndecided;
};

Result<RepeatedGhost> repeat_for_ghost(const fs::path& recording, const GhostWanted& wanted,
                                       const SeeGhost& see) {
  const auto header = header_for_ghost(recording, wanted);
  if (!header) return tl::unexpected(header.error());
  const auto settings = parse_settings(header->settings_json);
  if (!settings) return tl::unexpected(settings.error());
  GhostTrackMaker maker(settings->haptic.tick_s);
  DebriefOrder order;
  order.recording = recording;
  order.case_spec = wanted.case_spec;
  order.on_judged = [&](std::span<const ToolState* const> tools, const ScenarioState& state) {
    const std::size_t known = maker.so_far().stretches.size();
    maker.add(tools, state);
    if (!see || maker.so_far().stretches.size() == known) return;
    GhostTrack part = maker.so_far();
    part.tray = settings->tray;
    see(std::move(part));
  };
  const auto debrief = make_debrief(order);
  if (!debrief) return tl::unexpected(debrief.error());
  if (!debrief->identical)
    return fail("the recording does not repeat exactly", recording.string(),
                "Record it again with this version of Osteon");
  RepeatedGhost repeated{maker.finish(settings->tray), debrief->outcome->verdict};
  if (repeated.track.stretches.empty())
    return fail("nothing that the exercise asks for is done in the recording", recording.string());
  return repeated;
}

// What was repeated once by this program need not be repeated again.
std::optional<GhostTrack> known_example(const fs::path& recording) {
  constexpr std::uintmax_t kMostBytes = 256u << 20;
  const auto bytes = read_file(kept_way(recording), kMostBytes);
  const std::uint64_t key = ghost_key(recording);
  if (!bytes || key == 0) return std::nullopt;
  auto track = ghost_from_bytes(*bytes, key);
  return track ? std::optional(std::move(*track)) : std::nullopt;
}

// One who does not pass himself is no example.
Result<GhostTrack> example_of(const fs::path& recording, const GhostWanted& wanted,
                              const SeeGhost& see) {
  auto repeated = repeat_for_ghost(recording, wanted, see);
  if (!repeated) return tl::unexpected(repeated.error());
  if (repeated->verdict == Verdict::kNotPassed)
    return fail("the virtual expert does not pass on this patient", wanted.case_spec);
  // Where it cannot be kept it is repeated the next time.
  if (const std::uint64_t key = ghost_key(recording); key != 0)
    (void)write_file_atomic(kept_way(recording), to_bytes(repeated->track, key));
  return std::move(repeated->track);
}

}  // namespace

Result<GhostTrack> ghost_of_recording(const fs::path& recording, const GhostWanted& wanted,
                                      const SeeGhost& see) {
  auto repeated = repeat_for_ghost(recording, wanted, see);
  if (!repeated) return tl::unexpected(repeated.error());
  return std::move(repeated->track);
}

fs::path expert_recording(const GhostWanted& wanted) {
  Hasher hash;
  hash.add(std::string_view(OSTEON_VERSION));
  hash.add(std::string_view(wanted.scenario.source_text));
  hash.add(std::string_view(wanted.case_spec));
  hash.add(wanted.case_hash);
  if (!wanted.graft_json.empty()) hash.add(std::string_view(wanted.graft_json));
  if (!wanted.to_stage.empty()) hash.add(std::string_view(wanted.to_stage));
  char name[24];
  std::snprintf(name, sizeof name, "-%016llx.osr", static_cast<unsigned long long>(hash.value()));
  return cache_dir() / "experts" / (wanted.scenario.name + name);
}

fs::path kept_expert(const GhostWanted& wanted) {
  GhostWanted whole = wanted;
  whole.to_stage.clear();
  std::error_code ec;
  const fs::path file = expert_recording(whole);
  return fs::exists(file, ec) ? file : expert_recording(wanted);
}

Result<fs::path> recorded_expert(const GhostWanted& wanted, const std::function<bool()>& go_on,
                                 const fs::path& program) {
  const fs::path file = kept_expert(wanted);
  std::error_code ec;
  if (fs::exists(file, ec)) return file;
  if (auto ok = record_expert(wanted, file, go_on, program); !ok) return tl::unexpected(ok.error());
  return file;
}

Result<GhostTrack> ghost_of_expert(const GhostWanted& wanted, const std::function<bool()>& go_on,
                                   const fs::path& program, const SeeGhost& see) {
  const fs::path kept_at = kept_expert(wanted), file = expert_recording(wanted);
  std::error_code ec;
  if (fs::exists(kept_at, ec)) {
    if (auto known = known_example(kept_at)) return std::move(*known);
    auto kept = example_of(kept_at, wanted, see);
    if (kept || !go_on()) return kept;
    fs::remove(kept_at, ec);  // of an older build, or damaged
  }
  if (auto ok = record_expert(wanted, file, go_on, program); !ok) return tl::unexpected(ok.error());
  if (!go_on()) return fail("stopped");
  if (auto known = known_example(file)) return std::move(*known);
  return example_of(file, wanted, see);
}

double ghost_strength_of(const std::string& learner, const std::string& scenario) {
  const auto store = ResultStore::open(results_place(), 0.2);
  if (!store) return 1;
  const auto rows = store->list({learner, scenario});
  if (!rows) return 1;
  std::vector<bool> passed;
  for (const AttemptRow& row : *rows)
    if (!was_guided(row)) passed.push_back(row.verdict == "passed");
  return ghost_strength(passed);
}

}  // namespace osteon
