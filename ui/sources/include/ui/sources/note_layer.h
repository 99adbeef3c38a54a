// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A layer over the field, a plot or a video that shows the notes of the moment, draws new ones with
// the tool of the board, and lets the mouse move and change those that are there. It lies over a
// surface whose mouse events it takes as far as they concern notes; everything else goes on to the
// surface. UI thread only.

#include <QTransform>
#include <QWidget>
#include <functional>
#include <optional>

#include <telemetry/session/drawn_notes.h>

namespace pitchboard::ui {

class NoteBoard;

/// Where notes are drawn.
struct NoteGround {
  telemetry::NotePlace place = telemetry::NotePlace::Field;
  /// What a note belongs to that is drawn from this pixel; empty: none can be drawn here.
  struct Owner {
    std::string on, unit;
  };
  std::function<std::optional<Owner>(const QPointF& pixel)> owner;
  /// Leads from the coordinates of notes of this owner to pixels; empty: they are not shown here.
  std::function<std::optional<QTransform>(const std::string& on)> toPixels;
  /// The part of the surface in which they are drawn (px).
  std::function<QRectF()> area;
};

class NoteLayer : public QWidget {
  Q_OBJECT
 public:
  /// `board` outlives it. `parent` is the surface itself, or what the surface lies in.
  NoteLayer(NoteBoard* board, NoteGround ground, QWidget* surface, QWidget* parent);

  /// The surface shows something else, or in another place.
  void refresh();
  /// Returns the note at this pixel that is on top; 0: none.
  quint64 noteAt(const QPointF& pixel) const;
  bool eventFilter(QObject* watched, QEvent* event) override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  enum class Grip { None, Whole, From, To };
  struct Shown {
    quint64 id = 0;
    telemetry::DrawnNote note;
    QTransform toPixels;
    bool isNow = true;
  };
  std::vector<Shown> shownNotes() const;
  std::optional<Shown> shown(quint64 id) const;
  bool press(const QPointF& at);
  bool move(const QPointF& at, bool isHeld);
  bool release();
  void begin(const QPointF& at);
  void edit(quint64 id, const QPoint& global);
  void openMenu(quint64 id, const QPoint& global);
  void fit();
  Grip gripAt(const Shown& one, const QPointF& at) const;
  bool showHover(const QPointF& at);
  QPoint globalOf(const QPointF& pixel) const;

  NoteBoard* m_board;
  NoteGround m_ground;
  QWidget* m_surface;
  quint64 m_hovered = 0;  // its ends can be seen
  // What is drawn or moved; its id is 0 while it is new.
  std::optional<Shown> m_held;
  Grip m_grip = Grip::None;
  QPointF m_from;
  telemetry::DrawnNote m_before;
};

}  // namespace pitchboard::ui
