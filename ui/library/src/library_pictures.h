// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The small pictures of sessions: the field at a telling moment. They are made when they are asked
// for, the newest request first, and kept as files. A thread reads files and sessions; the field
// is painted on the UI thread, one picture per turn of the event loop. UI thread only.

#include <QCache>
#include <QObject>
#include <QPixmap>
#include <QSet>
#include <deque>
#include <memory>

#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>
#include <ui/sources/field_pictures.h>

#include "library_row.h"

namespace pitchboard::ui {

class LibraryPictures : public QObject {
  Q_OBJECT
 public:
  /// `folder` is where pictures are kept; it is made when needed. `pictures` outlives this.
  LibraryPictures(QString folder, const FieldPictures* pictures, QObject* parent);
  ~LibraryPictures() override;

  /// Returns the picture, or a null one if it is not there yet or cannot be made; `came` follows
  /// once it is there.
  QPixmap pictureOf(const LibraryRowPtr& row);
  /// Pictures are made in the colours of the theme.
  void changeTheme();

 signals:
  void came(const pitchboard::ui::LibraryRowPtr& row);

 private:
  struct Request {
    LibraryRowPtr row;
    QString name;
  };
  void next();
  void paint(const Request& request, const FramePtr& frame);
  void show(const Request& request, const QImage& picture);

  const QString m_folder;
  const FieldPictures* m_pictures;
  std::unique_ptr<FramePainter> m_painter;  // of this theme
  QCache<QString, QPixmap> m_cache;
  std::deque<Request> m_wanted;
  QSet<QString> m_requested;  // waiting, or being made
  bool m_isWorking = false;
  UiQueue m_ui;
  Workers m_worker;  // last: waits for its work before the rest goes
};

}  // namespace pitchboard::ui
