// SPDX-License-Identifier: GPL-3.0-or-later
// The worlds of two libraries side by side: how many times as fast is the second? Two processes
// play the same by turns of some milliseconds, so that other programs slow down both; a ratio is
// the median of the turns. Each plays all cases one after the other, so that many worlds find the
// heap as others left it. A step is: commands written, a tick, percepts read; every ten seconds the
// worlds begin again. Hashes and blackboards of both must be the same.
//
//     worlds_side_by_side OLD_LIBRARY NEW_LIBRARY [WORD]      only cases whose name contains the
//     word

#include <dlfcn.h>
#include <pitchboard_sim.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

constexpr int turns = 15;
constexpr double turnSeconds = 0.03;

/// Processor time of this thread.
double now() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

[[noreturn]] void fail(const char* why) {
  std::fprintf(stderr, "error: %s\n", why);
  std::exit(2);
}

/// What one process tells the other, or a turn that it gives it.
template <class Value>
void send(int pipe, const Value& value) {
  if (::write(pipe, &value, sizeof value) != sizeof value) fail("the other process has ended");
}
template <class Value>
Value receive(int pipe) {
  Value value{};
  if (::read(pipe, &value, sizeof value) != sizeof value) fail("the other process has ended");
  return value;
}

class Library {
 public:
  explicit Library(const char* path) : m_handle(::dlopen(path, RTLD_NOW)) {
    if (m_handle == nullptr) fail(::dlerror());
  }
  template <class Function>
  Function* function(Function* /*of the header*/, const char* name) const {
    void* found = ::dlsym(m_handle, name);
    if (found == nullptr) fail(::dlerror());
    return reinterpret_cast<Function*>(found);
  }

 private:
  void* m_handle;
};
#define FUNCTION(library, name) (library).function(&(name), #name)

struct Case {
  std::size_t worlds;
  std::size_t robots;
  const char* noise;
  std::string name() const {
    return std::to_string(worlds) + " worlds, " + std::to_string(robots) + " robots, " + noise;
  }
};

/// Robots in two rows that look at each other across the ball; walks lead them among each other.
std::string scenarioOf(std::size_t robots) {
  std::string text = R"({"version": 1, "name": "side", "ball": {"x": 0.5, "y": 0.3}, "robots": [)";
  for (std::size_t i = 0; i < robots; ++i) {
    const bool left = i % 2 == 0;
    const auto row = static_cast<double>(i / 2);
    text += std::string(i > 0 ? ", " : "") + R"({"team": ")" + (left ? "blue" : "red") +
            R"(", "number": )" + std::to_string(i / 2 + 1) + R"(, "x": )" +
            (left ? "-1.5" : "1.5") + R"(, "y": )" + std::to_string(1.2 * row - 1.2) +
            R"(, "heading": )" + (left ? "0" : "180") + R"(, "behaviour": "none"})";
  }
  return text + "]}";
}

std::vector<Case> casesWith(const std::string& word) {
  std::vector<Case> cases;
  for (const char* noise : {"none", "paper", "realistic"}) {
    for (const std::size_t robots : {1U, 2U, 6U}) {
      for (const std::size_t worlds : {64U, 1024U, 4096U}) {
        const Case one{worlds, robots, noise};
        if (one.name().find(word) != std::string::npos) cases.push_back(one);
      }
    }
  }
  return cases;
}

/// The worlds of a case in one library.
class Player {
 public:
  Player(const Library& library, const Case& played)
      : m_write(FUNCTION(library, pb_write_commands)),
        m_step(FUNCTION(library, pb_step)),
        m_read(FUNCTION(library, pb_read)),
        m_reset(FUNCTION(library, pb_reset)),
        m_hashes(FUNCTION(library, pb_read_hashes)),
        m_boards(FUNCTION(library, pb_read_boards)),
        m_destroy(FUNCTION(library, pb_destroy)),
        m_error(FUNCTION(library, pb_last_error)),
        m_count(played.worlds),
        m_rows(played.worlds * played.robots),
        m_percepts(m_rows * FUNCTION(library, pb_column_count)(PB_PERCEPTS)),
        m_commands(m_rows * FUNCTION(library, pb_column_count)(PB_COMMANDS), PB_KEEP) {
    pb_options options;
    must(FUNCTION(library, pb_options_init)(&options, sizeof options));
    const std::string scenario = scenarioOf(played.robots);
    options.text = scenario.c_str();
    options.worlds = static_cast<std::int32_t>(played.worlds);
    options.noise = played.noise;
    must(FUNCTION(library, pb_create)(&options, &m_worlds));
  }
  ~Player() { m_destroy(m_worlds); }
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  double secondsOf(std::size_t ticks) {
    constexpr std::size_t newBeginning = 600;
    constexpr std::int32_t walks[] = {1, 2, 8, 3, 17, 6, 1, 7};
    const std::size_t columns = m_commands.size() / m_rows;
    const double begin = now();
    for (std::size_t i = 0; i < ticks; ++i, ++m_tick) {
      if (m_tick % newBeginning == 0) must(m_reset(m_worlds, PB_ALL, m_tick));
      for (std::size_t row = 0; row < m_rows; ++row) {
        m_commands[row * columns] = walks[(row + m_tick / 60) % std::size(walks)];
      }
      must(m_write(m_worlds, m_commands.data(), m_commands.size()));
      must(m_step(m_worlds, 1));
      must(m_read(m_worlds, PB_PERCEPTS, m_percepts.data(), m_percepts.size()));
    }
    return now() - begin;
  }

  /// A number for all that can be seen of the worlds.
  std::uint64_t digest() {
    std::vector<std::uint64_t> hashes(m_count);
    std::vector<std::uint32_t> boards(m_rows * PB_BOARD_WORDS);
    must(m_hashes(m_worlds, hashes.data(), hashes.size()));
    must(m_boards(m_worlds, boards.data(), boards.size()));
    std::uint64_t digest = 0;
    const auto add = [&](std::uint64_t value) { digest = (digest ^ value) * 0x100000001b3ULL; };
    for (const std::uint64_t hash : hashes) add(hash);
    for (const std::uint32_t word : boards) add(word);
    for (const double value : m_percepts)
      add(std::isnan(value) ? 1 : std::bit_cast<std::uint64_t>(value));
    return digest;
  }

 private:
  void must(pb_status status) const {
    if (status != PB_OK) fail(m_error());
  }
  decltype(&pb_write_commands) m_write;
  decltype(&pb_step) m_step;
  decltype(&pb_read) m_read;
  decltype(&pb_reset) m_reset;
  decltype(&pb_read_hashes) m_hashes;
  decltype(&pb_read_boards) m_boards;
  decltype(&pb_destroy) m_destroy;
  decltype(&pb_last_error) m_error;
  pb_worlds* m_worlds = nullptr;
  std::size_t m_count, m_rows;
  std::vector<double> m_percepts;
  std::vector<std::int32_t> m_commands;
  std::size_t m_tick = 0;
};

/// A process that plays all cases with one library.
class Playing {
 public:
  Playing(const char* library, const std::vector<Case>& cases) {
    int to[2], from[2];
    if (::pipe(to) != 0 || ::pipe(from) != 0) fail("no pipes");
    const pid_t child = ::fork();
    if (child < 0) fail("no second process");
    if (child == 0) {
      ::close(to[1]);
      ::close(from[0]);
      play(library, cases, to[0], from[1]);
      std::exit(0);
    }
    ::close(to[0]);
    ::close(from[1]);
    m_to = to[1];
    m_from = from[0];
  }
  /// Begins the next case.
  void begin() { (void)ask<char>(0); }
  double secondsOf(std::size_t ticks) { return ask<double>(ticks); }
  /// Ends the case.
  std::uint64_t digest() { return ask<std::uint64_t>(0); }

 private:
  static void play(const char* path, const std::vector<Case>& cases, int from, int to) {
    const Library library(path);
    for (const Case& one : cases) {
      receive<std::size_t>(from);
      Player player(library, one);
      send(to, char{});
      while (const auto ticks = receive<std::size_t>(from)) send(to, player.secondsOf(ticks));
      send(to, player.digest());
    }
  }
  template <class Answer>
  Answer ask(std::size_t ticks) {
    send(m_to, ticks);
    return receive<Answer>(m_from);
  }

  int m_to = -1, m_from = -1;
};

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + std::ssize(values) / 2);
  return values[values.size() / 2];
}

/// Returns whether both came to the same.
bool compare(Playing& old, Playing& now, const Case& one) {
  old.begin();
  now.begin();
  // As many ticks as fill a turn; the first ones warm up.
  constexpr std::size_t first = 4;
  const double tick = std::max(old.secondsOf(first), now.secondsOf(first)) / first;
  const auto ticks = static_cast<std::size_t>(std::max(2.0, turnSeconds / tick));
  std::vector<double> olds, news, ratios;
  for (int turn = 0; turn < turns; ++turn) {
    // Whoever comes second finds the processor as the other left it.
    const bool oldFirst = turn % 2 == 0;
    const double before = (oldFirst ? old : now).secondsOf(ticks);
    const double after = (oldFirst ? now : old).secondsOf(ticks);
    olds.push_back(oldFirst ? before : after);
    news.push_back(oldFirst ? after : before);
    ratios.push_back(olds.back() / news.back());
  }
  const bool same = old.digest() == now.digest();
  const double steps = static_cast<double>(ticks * one.worlds * one.robots);
  std::printf("%-32s %7.0f ns -> %5.0f ns a robot step, %.2f times as fast%s\n", one.name().c_str(),
              median(olds) / steps * 1e9, median(news) / steps * 1e9, median(ratios),
              same ? "" : ", RESULTS DIFFER");
  std::fflush(stdout);
  return same;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: worlds_side_by_side OLD_LIBRARY NEW_LIBRARY [WORD]\n");
    return 2;
  }
  const std::vector<Case> cases = casesWith(argc > 3 ? argv[3] : "");
  Playing old(argv[1], cases), now(argv[2], cases);
  bool same = true;
  for (const Case& one : cases) same = compare(old, now, one) && same;
  return same ? 0 : 1;
}
