// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The clock of the display. Whoever has something new to show requests the next beat. All parts
// that are due run in the same event, so that Qt repaints once. No fast timer runs while nothing is
// requested. UI thread only; each part is owned by whoever it calls.

#include <QObject>
#include <QPointer>
#include <QTimer>
#include <QWidget>
#include <chrono>
#include <functional>
#include <memory>
#include <vector>

namespace pitchboard::ui {

class Beat : public QObject {
 public:
  using Milliseconds = std::chrono::milliseconds;
  static constexpr Milliseconds period{16};

  /// Returns the beat of this program.
  static Beat& display();

  Beat();
  ~Beat() override;

  class Part {
   public:
    ~Part();
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;
    /// Requests a call in the next beat that is at least `least` after the last call.
    void want();
    /// Withdraws a request, because its work has already been done.
    void settle() { m_wanted = false; }
    void setLeast(Milliseconds least) { m_least = least; }

   private:
    friend class Beat;
    using Clock = std::chrono::steady_clock;
    Part() = default;
    bool canBeSeen() const { return m_always || (m_seen && m_seen->isVisible()); }

    Beat* m_beat = nullptr;
    QPointer<QWidget> m_seen;
    bool m_always = false, m_follows = true;
    Milliseconds m_least{0}, m_most{0};
    std::function<void()> m_call;
    bool m_wanted = false, m_running = false;
    Clock::time_point m_called{};
    quint64 m_calledIn = 0;  // the beat
  };

  /// Adds a part that calls `call` after a request, at most once per `least` and only while `seen`
  /// is visible; requests of a hidden widget wait until it is shown. If `seen` is null, it is
  /// always called. With `most`, it is also called without a request that long after the last call,
  /// with a precision of a quarter of a second.
  std::unique_ptr<Part> add(QWidget* seen, Milliseconds least, std::function<void()> call,
                            Milliseconds most = {});
  /// Adds a source of news that other parts show. They use its beats instead of beats of their own.
  std::unique_ptr<Part> addSource(std::function<void()> call);
  /// Returns whether no beat is requested.
  bool isIdle() const { return !m_next.isActive(); }
  /// Returns the number of beats so far.
  quint64 beats() const { return m_beats; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  using Clock = Part::Clock;
  Clock::time_point dueAt(const Part& part) const;
  void beat();
  void beatSlowly();
  void schedule();

  std::vector<Part*> m_parts;  // null: gone during a beat
  QTimer m_next, m_slow;
  quint64 m_beats = 0;
  int m_depth = 0;  // of beats; a call may run an event loop
  Clock::time_point m_last{};
};

}  // namespace pitchboard::ui
