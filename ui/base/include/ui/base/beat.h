// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The clock of what is shown. Whoever has something new to show wants the next beat; all that are
// due then run in one event, so that Qt makes one repaint of it. No timer runs while nobody wants
// anything. UI thread only; parts belong to those that they call.

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

  /// The one of this program.
  static Beat& display();

  Beat();
  ~Beat() override;

  class Part {
   public:
    ~Part();
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;
    /// Once, in the next beat that is late enough after the last call.
    void want();
    /// What was wanted has been done already.
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

  /// Calls `call` when it is wanted, at most every `least`, and only while `seen` is visible: what
  /// is wanted meanwhile comes when it is shown. Null: whether it is seen or not. With `most` also
  /// that long after the last call, without being wanted, to a quarter of a second.
  std::unique_ptr<Part> add(QWidget* seen, Milliseconds least, std::function<void()> call,
                            Milliseconds most = {});
  /// For what brings the news that others show: they wait for its beats rather than having their
  /// own.
  std::unique_ptr<Part> addSource(std::function<void()> call);
  /// Nobody waits for a beat.
  bool isIdle() const { return !m_next.isActive(); }
  /// How many there were.
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
