// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The line at the bottom: how the simulation runs or the network is received, what is recorded,
// where the cursor is, what is selected. Numbers change five times a second, so that they can be
// read.

#include <QElapsedTimer>
#include <QPointF>
#include <QStatusBar>
#include <vector>

#include <ui/base/beat.h>
#include <ui/live/live_status.h>

class QLabel;

namespace pitchboard::ui {

class LiveController;
class MatchController;
class NetworkShare;
class ReplayController;
class RobotSelection;
class SessionRecording;
class ShownMoment;

/// What the line tells of; everything outlives it.
struct StatusContext {
  MatchController* controller = nullptr;
  ShownMoment* shown = nullptr;
  RobotSelection* selection = nullptr;
  ReplayController* replay = nullptr;
  SessionRecording* recording = nullptr;
  LiveController* live = nullptr;
  NetworkShare* share = nullptr;
};

class StudioStatusBar : public QStatusBar {
  Q_OBJECT
 public:
  explicit StudioStatusBar(const StatusContext& context, QWidget* parent = nullptr);
  void setCursor(QPointF metres, bool valid);
  void copyStateHash();
  /// Shows a sentence for a few seconds.
  void note(const QString& sentence);

 private:
  /// A label at the left and the line before it.
  struct Part {
    QWidget* line;
    QLabel* label;
  };

  void refresh();
  void showSource();
  void hideEmpty();
  QPalette alarmPalette() const;
  QString paceText(const link::MatchFrame& now) const;
  void showMatch(const link::MatchFrame& frame);
  void showMemory();
  void showShared();
  void showLive(const link::MatchFrame* frame);
  void showSelected(const link::MatchFrame& frame);
  QLabel* addLabel(const char* name, bool atRight);

  StatusContext m_context;
  LiveStatus m_live;
  QElapsedTimer m_clock;
  std::unique_ptr<Beat::Part> m_refresh;
  std::vector<Part> m_parts;
  QLabel* m_pace;
  QLabel* m_world;
  QLabel* m_processes;
  QLabel* m_recording;
  QLabel* m_shared;
  QLabel* m_cursor;
  QLabel* m_selected;
};

}  // namespace pitchboard::ui
