// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/query/find_moments.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include <base/try.h>

#include "asked_questions.h"
#include "possible_times.h"

namespace pitchboard::telemetry {
namespace {

/// Below this many rows, opening a file again for another thread costs more than it saves.
constexpr std::uint64_t minRowsToSplit = 100'000;

/// The stretches of every curve in some ranges. Returns false if `goOn` did.
bool findIn(const SessionReader& session, AskedQuery& query, std::span<const AskedQuestion> asked,
            std::span<const TimeRange> ranges, std::vector<Stretches>& out,
            const std::function<bool()>& goOn) {
  out.assign(query.query->curves().size(), {});
  return std::ranges::all_of(ranges, [&](const TimeRange& range) {
    return addStretches(session, query, asked, range, out,
                        [&goOn](double) { return !goOn || goOn(); });
  });
}

/// Cuts ranges into `parts` lists that last about equally long.
std::vector<std::vector<TimeRange>> cutInto(std::size_t parts,
                                            const std::vector<TimeRange>& ranges) {
  double length = 0.0;
  for (const TimeRange& range : ranges) length += range.end - range.begin;
  const double each = length / static_cast<double>(parts);
  std::vector<std::vector<TimeRange>> out(1);
  double filled = 0.0;
  for (TimeRange rest : ranges) {
    while (out.size() < parts && filled + (rest.end - rest.begin) > each) {
      const double end = rest.begin + (each - filled);
      // Closed ranges that do not share a time: files have whole nanoseconds.
      if (end > rest.begin) out.back().push_back({rest.begin, end});
      rest.begin = end > rest.begin ? end + 1e-9 : rest.begin;
      out.emplace_back();
      filled = 0.0;
    }
    out.back().push_back(rest);
    filled += rest.end - rest.begin;
  }
  return out;
}

/// Appends the notes of a reader that are not there yet.
void takeNotes(const SessionReader& session, FileMoments& out) {
  for (const std::string& note : session.notes()) {
    if (std::ranges::count(out.notes, note) == 0) out.notes.push_back(note);
  }
  out.isDamaged = out.isDamaged || session.isDamaged();
}

Result<void> searchFile(const std::string& path, const FindOptions& options,
                        std::span<const AskedQuestion> asked, unsigned threads,
                        const std::function<bool()>& goOn, FileMoments& out) {
  McapReaderOptions reading;
  reading.progress = [&goOn](double) { return goOn(); };
  const SessionReader session = TRY(SessionReader::open(path, reading));
  out.isForeign = session.isForeign();
  takeNotes(session, out);
  if (out.isForeign) return {};
  AskedQuery query = resolvedFor(session, asked);
  out.unanswered = query.unanswered;
  if (!query.query && !out.unanswered.empty()) {
    return tl::unexpected(out.unanswered.front().error);
  }
  const auto range = session.range();
  if (!query.query || !range) return {};
  std::optional<std::vector<TimeRange>> possible;
  if (options.usesSummaries) {
    std::vector<std::string> conditions;
    for (const std::size_t i : query.questions) {
      conditions.push_back(options.questions[i].condition);
    }
    possible = possibleTimes(session, *query.query, conditions, goOn);
  }
  const std::vector<TimeRange> ranges = possible.value_or(std::vector<TimeRange>{*range});
  double read = 0.0;
  for (const TimeRange& one : ranges) {
    read += std::max(0.0, std::min(one.end, range->end) - std::max(one.begin, range->begin));
  }
  if (range->end > range->begin) out.share = read / (range->end - range->begin);
  std::uint64_t rows = 0;
  for (const SessionGroup& group : session.groups()) rows += group.rows;
  // Without an index, every reader would have to scan the whole file.
  const bool isSplit = threads > 1 && session.file().contents().indexed &&
                       static_cast<double>(rows) * out.share >= minRowsToSplit;
  const auto parts = cutInto(isSplit ? threads : 1, ranges);
  std::vector<std::vector<Stretches>> found(parts.size());
  std::mutex guard;  // of `out`
  std::vector<std::thread> helpers;
  for (std::size_t part = 1; part < parts.size(); ++part) {
    helpers.emplace_back([&, part] {
      auto own = SessionReader::open(path, reading);
      if (!own) {
        const std::lock_guard lock(guard);
        out.error = own.error();
        return;
      }
      AskedQuery ownQuery = resolvedFor(*own, asked);
      if (ownQuery.query) (void)findIn(*own, ownQuery, asked, parts[part], found[part], goOn);
      const std::lock_guard lock(guard);
      takeNotes(*own, out);
    });
  }
  (void)findIn(session, query, asked, parts.front(), found.front(), goOn);
  for (std::thread& helper : helpers) helper.join();
  takeNotes(session, out);
  std::vector<Stretches> all = std::move(found.front());
  for (std::size_t part = 1; part < found.size(); ++part) {
    for (std::size_t c = 0; c < found[part].size(); ++c) all[c].append(found[part][c]);
  }
  for (std::size_t c = 0; c < all.size(); ++c) {
    const std::size_t question = query.questionOf(c);
    addMoments(all[c].found(), question, asked[question], query.query->curves()[c].robot,
               out.moments);
  }
  std::ranges::stable_sort(out.moments, {}, [](const FoundMoment& one) { return one.range.begin; });
  return {};
}

}  // namespace

Result<void> checkQuestion(const MomentQuestion& question) {
  auto parsed = Expression::parse(question.condition, eachRobot);
  if (!parsed) {
    Error error = parsed.error();
    error.message = "The condition cannot be read: " + error.message + ".";
    return tl::unexpected(error);
  }
  const bool hasEach = std::ranges::any_of(
      parsed->variables(), [](const std::string& name) { return name.starts_with("each/"); });
  if (!question.robots.empty() && !hasEach) {
    return failure(ErrorCode::InvalidArgument,
                   "The condition names its robots itself. Leave out the list of robots, or write "
                   "variables without a robot, such as VISION_BALL_DIST.");
  }
  if (!(question.least >= 0.0)) {
    return failure(ErrorCode::InvalidArgument, "The duration must not be negative.");
  }
  return {};
}

Result<void> findMoments(std::span<const std::string> files, const FindOptions& options,
                         const std::function<bool(std::size_t file, FileMoments&& found)>& report,
                         const std::function<bool()>& goOn) {
  for (const MomentQuestion& question : options.questions) TRY(checkQuestion(question));
  const std::vector<AskedQuestion> asked = askedOf(options.questions);
  const unsigned threads =
      options.threads > 0 ? options.threads : std::max(1U, std::thread::hardware_concurrency());
  const auto outer = static_cast<unsigned>(std::min<std::size_t>(threads, files.size()));
  const unsigned inner = outer > 0 ? std::max(1U, threads / outer) : 1U;
  std::atomic<bool> isStopped = false;
  const std::function<bool()> mayGoOn = [&] { return !isStopped && (!goOn || goOn()); };
  std::vector<std::optional<FileMoments>> done(files.size());
  std::mutex guard;  // of `done` and `next`
  std::condition_variable changed;
  std::size_t next = 0, reported = 0;
  // Results wait for those of the files before them; a thread does not run far ahead.
  const std::size_t maxWaiting = 64 + 4 * std::size_t{threads};
  std::vector<std::thread> workers;
  for (unsigned i = 0; i < outer; ++i) {
    workers.emplace_back([&] {
      for (;;) {
        std::size_t file = 0;
        {
          std::unique_lock lock(guard);
          changed.wait(lock, [&] { return isStopped || next < reported + maxWaiting; });
          if (isStopped || next == files.size()) return;
          file = next++;
        }
        FileMoments found;
        if (const auto searched = searchFile(files[file], options, asked, inner, mayGoOn, found);
            !searched) {
          found.error = searched.error();
        }
        const std::lock_guard lock(guard);
        done[file] = std::move(found);
        changed.notify_all();
      }
    });
  }
  for (std::size_t file = 0; file < files.size() && !isStopped; ++file) {
    std::optional<FileMoments> found;
    {
      std::unique_lock lock(guard);
      changed.wait(lock, [&] { return done[file].has_value(); });
      found = std::move(done[file]);
      done[file].emplace();  // without the moments, which may be many
      reported = file + 1;
    }
    changed.notify_all();
    if ((goOn && !goOn()) || !report(file, std::move(*found))) {
      const std::lock_guard lock(guard);
      isStopped = true;
    }
    changed.notify_all();
  }
  for (std::thread& worker : workers) worker.join();
  return {};
}

}  // namespace pitchboard::telemetry
