// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The source that the window shows at the moment: passes on what the chosen one says. The others
// go on running unseen.

#include <ui/frame_source.h>

namespace pitchboard::ui {

class SourceSwitch : public FrameSource {
  Q_OBJECT
 public:
  /// Sources outlive the switch.
  explicit SourceSwitch(FrameSource* first, QObject* parent = nullptr);

  FrameSource* current() const { return m_current; }
  /// Offers a further source; the mode buttons follow.
  void add(FrameSource* source) { m_sources.push_back(source); }
  const std::vector<FrameSource*>& sources() const { return m_sources; }
  /// The source of this kind, or nullptr.
  FrameSource* find(SourceKind kind) const;
  /// Shows this source from now on; `restarted` and `changed` follow.
  void choose(FrameSource* source);

  SourceKind kind() const override { return m_current->kind(); }
  FramePtr frame() const override { return m_current->frame(); }
  std::shared_ptr<const telemetry::SeriesStore> series() const override {
    return m_current->series();
  }
  QString emptyText() const override { return m_current->emptyText(); }

 signals:
  void changed();

 private:
  void follow();
  FrameSource* m_current;
  std::vector<FrameSource*> m_sources;
};

}  // namespace pitchboard::ui
