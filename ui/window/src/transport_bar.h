// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The tool bar: mode; scenario, transport and speed of a simulation, or ports and team of Live;
// scoreboard. UI thread only.

#include <QToolBar>
#include <array>
#include <vector>

#include <ui/base/beat.h>
#include <ui/sources/frame_source.h>

class QComboBox;
class QSettings;
class QToolButton;

namespace pitchboard::ui {

class LiveBar;
class LiveController;
class MatchController;
class ReplayController;
class ScenarioChooser;
class Scoreboard;
class SessionRecording;
class ShownMoment;

/// What the bar shows and moves; everything outlives it.
struct TransportContext {
  MatchController* controller = nullptr;
  ShownMoment* shown = nullptr;
  ReplayController* replay = nullptr;
  SessionRecording* recording = nullptr;
  LiveController* live = nullptr;
};

/// Simulated seconds per second that are offered.
extern const std::array<double, 8> matchSpeeds;
/// "0.25×", "max".
QString speedText(double speed);

class TransportBar : public QToolBar {
  Q_OBJECT
 public:
  TransportBar(const TransportContext& context, QSettings* settings, QWidget* parent);
  ScenarioChooser* scenarios() const { return m_scenarios; }
  /// Restart, play/pause, step: for the menu too.
  QList<QAction*> transportActions() const { return {m_restart, m_play, m_step}; }
  /// To kick-off, to the next event.
  QList<QAction*> skipActions() const { return m_skips; }
  /// Buttons of these in Replay.
  void addReplayActions(const QList<QAction*>& actions);
  /// Slower, faster.
  QList<QAction*> speedSteps() const { return m_speedSteps; }

 signals:
  void sourceRequested(const pitchboard::ui::SourceKind& kind);

 protected:
  bool event(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  /// At the right, whatever else has room: what is hidden first is not the score.
  void placeScoreboard();
  bool isFinished() const;
  bool hasNoReferee() const;
  void addModes();
  /// Shown while this source is; hidden otherwise.
  void addControl(const FrameSource* source, QAction* action) {
    m_controls.push_back({source, action});
  }
  void showMode();
  void addTransport();
  void addSkip();
  void addRecord();
  void showRecord();
  /// What the buttons move when not the match; null otherwise.
  ShownMoment* played() const;
  void showTransport();
  /// Of the match, or of what is played back.
  void setSpeed(double speed);
  double nextSpeed(int by) const;

  struct Control {
    const FrameSource* source;
    QAction* action;
  };

  TransportContext m_context;
  std::vector<Control> m_modes;  // their buttons' actions
  std::vector<Control> m_controls;
  ScenarioChooser* m_scenarios;
  Scoreboard* m_scoreboard;
  LiveBar* m_liveBar;
  QComboBox* m_speed;
  QToolButton* m_record = nullptr;
  QAction* m_recordAction = nullptr;
  QAction* m_restart;
  QAction* m_play;
  QAction* m_step;
  QList<QAction*> m_speedSteps, m_skips;
  bool m_finished = false, m_withoutReferee = false;
  std::unique_ptr<Beat::Part> m_refresh;
};

}  // namespace pitchboard::ui
