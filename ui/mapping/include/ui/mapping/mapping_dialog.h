// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The dialog in which people say what the topics of a recording, or of a robot's Foxglove bridge,
// mean: they drag fields onto "x of robot 3", see the field at a moment, and save the mapping as a
// file (robotlink/live/topic_mapping.h). Reads in the background. UI thread only.

#include <QDialog>
#include <QStringList>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/import/mapping_sample.h>
#include <telemetry/foxglove/foxglove_address.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;
class QSlider;
class QSpinBox;
class QTableWidget;
class QToolButton;

namespace pitchboard::ui {

class InPlaceMessage;
class MappedField;
class MeaningTree;
class OffsetStrip;
class TopicTree;

/// What is mapped.
struct MappingSource {
  QString name;  ///< "walk.mcap", "ws://robot3:8765"
  /// Returns what is read. Called once, on a worker's thread.
  std::function<Result<link::OpenRecordings>(const std::function<bool()>& goesOn)> prepare;
  QString file;            ///< of the mapping: it is read if it exists, and saved there
  QStringList recordings;  ///< files or folders; empty: a connection, which has no offsets
};
/// The recordings with these files or folders, each by itself, and the mapping beside the first
/// one.
MappingSource mappingSource(const QStringList& recordings);
/// Messages of a few seconds of a Foxglove bridge.
MappingSource mappingSource(const telemetry::FoxgloveAddress& bridge, const QString& file);

class MappingDialog : public QDialog {
  Q_OBJECT
 public:
  MappingDialog(MappingSource source, QWidget* parent);
  ~MappingDialog() override;

  const link::TopicMapping& mapping() const { return m_mapping; }
  /// Returns whether everything that was changed is on the field.
  bool isUpToDate() const { return m_pending == 0; }
  /// Puts a field into a place, as dropping it there does.
  void put(std::size_t robot, link::MappingSlot slot, const link::TopicField& field);

 signals:
  /// The mapping was saved and shall be used, with these recordings.
  void used(const QString& file, const QStringList& recordings);

 private:
  QWidget* makeTopics();
  QWidget* makeMeanings();
  QWidget* makeRobotForm();
  QWidget* makePreview();
  QWidget* makeTimes();
  QWidget* makeAlignment();
  QWidget* makeButtons();
  void readFile();
  void nameAll();
  void prepare();
  void change(const std::function<void(link::TopicMapping&)>& how);
  void sample();
  void showSample(const link::MappingSample& sample);
  void showMapping();
  void showRobot();
  void showTimes();
  void takeRobotForm();
  void addRobot();
  void removeRobot();
  void addRecordings();
  void moveRecording(std::size_t recording, double seconds);
  void setClock(std::size_t recording, link::RecordingClock clock);
  void alignBy(int which);
  void alignByTimes();
  void alignByEvent(link::AlignEvent event);
  void showAlignment();
  link::MappedRecording& timingOf(link::TopicMapping& mapping, std::size_t recording) const;
  void fillUseMenu();
  bool save(const QString& file);
  void openMapping();
  void saveAs();
  void use();
  void showProblem(const QString& sentence);

  MappingSource m_source;
  link::TopicMapping m_mapping;
  bool m_isGiven = false;  ///< not the usual one that follows from the topics
  std::vector<link::SampledTopic> m_topics;
  std::vector<link::SampledRecording> m_recordings;
  std::optional<link::OpenRecordings> m_open;
  double m_end = 0.0;  ///< s
  bool m_isShowing = false;

  TopicTree* m_topicTree = nullptr;
  MeaningTree* m_meanings = nullptr;
  MappedField* m_field = nullptr;
  OffsetStrip* m_strip = nullptr;
  QTableWidget* m_times = nullptr;
  QComboBox* m_align = nullptr;
  QWidget *m_timesPage = nullptr, *m_robotForm = nullptr, *m_alignRow = nullptr;
  QSpinBox* m_number = nullptr;
  QComboBox *m_team = nullptr, *m_frame = nullptr, *m_unit = nullptr, *m_angleUnit = nullptr,
            *m_ballFrame = nullptr, *m_ballUnit = nullptr;
  QCheckBox* m_attacksLeft = nullptr;
  QToolButton* m_useAs = nullptr;
  QPushButton *m_assign = nullptr, *m_use = nullptr;
  QSlider* m_moment = nullptr;
  QLabel* m_momentText = nullptr;
  QListWidget* m_problems = nullptr;
  InPlaceMessage* m_message = nullptr;

  std::shared_ptr<std::atomic<int>> m_generation = std::make_shared<std::atomic<int>>(0);
  int m_pending = 0;
  UiQueue m_toUi;
  Workers m_worker;  ///< last: it uses the rest
};

}  // namespace pitchboard::ui
