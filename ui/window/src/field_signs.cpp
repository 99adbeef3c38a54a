// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_signs.h"

#include <QAction>
#include <QEvent>
#include <QLabel>
#include <QPainter>
#include <QSettings>
#include <QUndoStack>
#include <algorithm>
#include <functional>

#include <ui/base/scoreboard_state.h>
#include <ui/base/theme.h>
#include <ui/base/time_axis.h>
#include <ui/field/field_view.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

class FieldSign : public QLabel {
 public:
  FieldSign(QWidget* canvas, const QString& objectName, QColor ThemeColors::*line)
      : QLabel(canvas), m_line(line) {
    setObjectName(objectName);
    setAlignment(Qt::AlignCenter);
    setFont(themeFont(TypeRole::Body, true));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    canvas->installEventFilter(this);
    hide();
  }

  /// What to say now; empty: nothing.
  std::function<QString()> textNow;
  /// With one the sign takes the mouse.
  std::function<void()> clicked;
  /// Where; its size is what the text needs.
  std::function<QRect(QSize)> place;
  /// It is placed again with every frame, and whenever another sign comes, goes or moves.
  bool givesWay = false;

  void present() {
    const QString text = textNow();
    setText(text);
    setVisible(!text.isEmpty());
    if (!text.isEmpty()) {
      setWordWrap(false);  // its size hint is that of one line
      setGeometry(place(sizeHint()));
      raise();
    }
    if (!givesWay) moveThoseThatGiveWay();
  }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::Resize && isVisible()) present();
    return QLabel::eventFilter(watched, event);
  }
  void mousePressEvent(QMouseEvent*) override {
    if (clicked) clicked();
  }
  void paintEvent(QPaintEvent* event) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(theme().*m_line);
    painter.setBrush(theme().window);
    painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 3, 3);
    painter.end();
    QLabel::paintEvent(event);
  }

 private:
  void moveThoseThatGiveWay() {
    for (QObject* child : parent()->children()) {
      auto* sign = dynamic_cast<FieldSign*>(child);
      if (sign && sign->givesWay && !sign->isHidden()) sign->present();
    }
  }

  QColor ThemeColors::*m_line;
};

/// In the middle of the upper edge; text that is wider than the field takes a second line.
QRect topOfField(FieldSign& sign, const QWidget& canvas, QSize text) {
  const int room = canvas.width() - scaled(&sign, 16), padding = scaled(&sign, 24);
  const bool fits = text.width() + padding <= room;
  sign.setWordWrap(!fits);
  QRect box(0, 0, std::min(text.width() + padding, room), scaled(&sign, fits ? 28 : 46));
  // Where the field is alone the scoreboard stands above it.
  box.moveTop(scaled(&sign, canvas.window()->isFullScreen() ? 44 : 8));
  box.moveLeft((canvas.width() - box.width()) / 2);
  return box;
}

/// As the frames of `source` want it.
void presentFrames(FieldSign* sign, FrameSource* source) {
  const auto present = [sign] {
    // Most frames say the same, but robots move, which one that gives way must not cover.
    if (sign->textNow() != sign->text() || sign->isVisible() == sign->text().isEmpty() ||
        (sign->givesWay && sign->isVisible()))
      sign->present();
  };
  QObject::connect(source, &FrameSource::frameReceived, sign, present);
  QObject::connect(source, &FrameSource::restarted, sign, present);
}

}  // namespace

QWidget* makeOpeningSign(MatchController* controller, QWidget* canvas) {
  auto* sign = new FieldSign(canvas, QStringLiteral("openingLabel"), &ThemeColors::innerLine);
  sign->textNow = [controller] {
    const bool wanted = !controller->frame() && (controller->isOpening() || controller->isOpen());
    const QString title = QString::fromStdString(controller->scenario().title);
    return wanted ? QStringLiteral("Opening %1…").arg(title) : QString();
  };
  sign->place = [sign, canvas](QSize) {
    const QRect area = canvas->rect();
    // Wide enough to cover the field's own sentence.
    QRect box(0, 0, qMin(area.width(), scaled(sign, 440)), scaled(sign, 40));
    box.moveCenter({area.center().x(), area.top() + qRound(area.height() * 0.36)});
    return box;
  };
  for (const auto changed : {&MatchController::scenarioChanged, &MatchController::opened}) {
    QObject::connect(controller, changed, sign, &FieldSign::present);
  }
  QObject::connect(controller, &MatchController::frameReceived, sign, &QWidget::hide);
  return sign;
}

void makeFirstSteps(ShownMoment* shown, MatchController* controller, const QList<QAction*>& actions,
                    QSettings* settings, QWidget* canvas) {
  static const QString wantedKey = QStringLiteral("window/firstSteps");
  if (!settings->value(wantedKey, true).toBool()) return;
  auto* sign = new FieldSign(canvas, QStringLiteral("firstSteps"), &ThemeColors::accentLine);
  sign->textNow = [shown] {
    const bool plays = shown->kind().canBeEdited && shown->frame();
    return plays ? QStringLiteral("Drag the ball  ·  Space pauses  ·  F1 shows all keys")
                 : QString();
  };
  sign->place = [sign, canvas](QSize text) { return topOfField(*sign, *canvas, text); };
  const auto present = [sign] {
    if (sign->isVisible() == sign->textNow().isEmpty()) sign->present();
  };
  QObject::connect(shown, &FrameSource::frameReceived, sign, present);
  QObject::connect(shown, &FrameSource::restarted, sign, present);
  const auto leave = [sign, settings] {
    settings->setValue(wantedKey, false);
    sign->hide();
    sign->deleteLater();
  };
  for (QAction* action : actions) QObject::connect(action, &QAction::triggered, sign, leave);
  QObject::connect(controller->edits()->undoStack(), &QUndoStack::indexChanged, sign, leave);
  QObject::connect(shown, &ShownMoment::lookingBackChanged, sign, leave);
}

QWidget* makeFinalWhistleSign(ShownMoment* shown, QWidget* canvas) {
  auto* sign = new FieldSign(canvas, QStringLiteral("finalWhistle"), &ThemeColors::innerLine);
  sign->textNow = [shown] {
    const FramePtr frame = shown->frame();
    const bool over = shown->kind().canBeEdited && frame && frame->finished &&
                      frame->origin == link::FrameOrigin::Simulated;
    if (!over) return QString();
    const ScoreboardState board = scoreboardOf(*frame);
    return QStringLiteral("%1: %2 %3 : %4 %5. Space plays again, or look back on the timeline.")
        .arg(frame->game ? QStringLiteral("Final whistle") : QStringLiteral("The match is over"),
             board.leftName)
        .arg(board.left)
        .arg(board.right)
        .arg(board.rightName);
  };
  sign->place = [sign, canvas](QSize text) { return topOfField(*sign, *canvas, text); };
  const auto present = [sign] {
    if (sign->isVisible() == sign->textNow().isEmpty()) sign->present();
  };
  QObject::connect(shown, &FrameSource::frameReceived, sign, present);
  QObject::connect(shown, &FrameSource::restarted, sign, present);
  QObject::connect(shown, &ShownMoment::sourceChosen, sign, present);
  return sign;
}

QWidget* makePenaltyStrip(FrameSource* source, const FieldView* field, QWidget* canvas) {
  auto* sign = new FieldSign(canvas, QStringLiteral("penaltyStrip"), &ThemeColors::innerLine);
  sign->textNow = [source] {
    const FramePtr frame = source->frame();
    return frame ? scoreboardOf(*frame).penalties : QString();
  };
  sign->givesWay = true;
  sign->place = [sign, field, canvas](QSize text) {
    // Below the others; what is wider than the field takes a second line.
    const int edge = scaled(sign, 8), room = canvas->width() - 2 * edge;
    const int whole = text.width() + scaled(sign, 16);
    sign->setWordWrap(whole > room);
    QRect box(0, edge, qMin(whole, room), scaled(sign, whole > room ? 38 : 22));
    box.moveRight(canvas->width() - edge - 1);
    QRect lower = box;
    lower.moveBottom(canvas->height() - edge - 1);
    if (field->hasRobotIn(box) && !field->hasRobotIn(lower)) return lower;
    for (const QObject* child : canvas->children()) {
      const auto* other = dynamic_cast<const FieldSign*>(child);
      if (other && other != sign && !other->isHidden() && box.intersects(other->geometry())) {
        box.moveTop(other->geometry().bottom() + 1 + edge / 2);
      }
    }
    return box;
  };
  presentFrames(sign, source);
  return sign;
}

QWidget* makeNobodyPlaysSign(FrameSource* source, QWidget* canvas) {
  auto* sign = new FieldSign(canvas, QStringLiteral("nobodyPlaysSign"), &ThemeColors::warningText);
  sign->textNow = [source] {
    const FramePtr frame = source->frame();
    return frame && frame->nobodyPlays
               ? QStringLiteral("No robot has been told to play. Choose rules in the Referee panel")
               : QString();
  };
  sign->place = [sign, canvas](QSize text) {
    const int high = scaled(sign, 22);
    QRect box(0, 0, qMin(canvas->width(), text.width() + scaled(sign, 16)), high);
    box.moveCenter({canvas->width() / 2, canvas->height() - high / 2 - scaled(sign, 8)});
    return box;
  };
  presentFrames(sign, source);
  return sign;
}

QWidget* makePublishedKeysSign(QAction* publishedKeys, QWidget* canvas) {
  auto* sign =
      new FieldSign(canvas, QStringLiteral("publishedKeysSign"), &ThemeColors::warningText);
  sign->setAttribute(Qt::WA_TransparentForMouseEvents, false);
  sign->setCursor(Qt::PointingHandCursor);
  sign->setToolTip(QStringLiteral(
      "Letter keys control robots, as in the published simulator. Click to turn this off."));
  sign->clicked = [publishedKeys] { publishedKeys->setChecked(false); };
  sign->textNow = [publishedKeys] {
    return publishedKeys->isChecked() ? QStringLiteral("Published keys are on") : QString();
  };
  sign->place = [sign, canvas](QSize text) {
    const int high = scaled(sign, 22), edge = scaled(sign, 8);
    return QRect(edge, canvas->height() - high - edge, text.width() + scaled(sign, 16), high);
  };
  QObject::connect(publishedKeys, &QAction::toggled, sign, &FieldSign::present);
  sign->present();
  return sign;
}

QWidget* makeLookingBackSign(ShownMoment* shown, QWidget* canvas) {
  auto* sign = new FieldSign(canvas, QStringLiteral("lookingBack"), &ThemeColors::accentLine);
  sign->textNow = [shown] {
    // As the line of this moment says it in the plots.
    return shown->isLookingBack() ? QStringLiteral("Viewing %1 · press Now to return")
                                        .arg(momentText(shown->time(), 2, shown->clock()))
                                  : QString();
  };
  sign->place = [sign, canvas](QSize text) { return topOfField(*sign, *canvas, text); };
  QObject::connect(shown, &ShownMoment::lookingBackChanged, sign, &FieldSign::present);
  QObject::connect(shown, &ShownMoment::moved, sign, &FieldSign::present);
  QObject::connect(shown, &ShownMoment::sourceChanged, sign, &FieldSign::present);
  return sign;
}

}  // namespace pitchboard::ui
