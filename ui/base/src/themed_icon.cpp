// SPDX-License-Identifier: GPL-3.0-or-later
// Icons of one colour: the shape comes from the Breeze theme, the colour from our own, at the
// moment of drawing, so that a change of theme needs no new icons.
#include <QApplication>
#include <QByteArray>
#include <QDir>
#include <QFile>
#include <QIconEngine>
#include <QPainter>
#include <QStandardPaths>
#include <QString>
#include <QSvgRenderer>
#include <memory>
#include <vector>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

struct Drawing {
  const char* name;
  const char* path;
};

constexpr Drawing drawings[] = {
    {"media-playback-start", "M4 3v16l15-8z"},
    {"media-playback-pause", "M4 3h5v16H4zM13 3h5v16h-5z"},
    {"media-skip-backward", "M3 3h2v16H3zM12 3v16L5 11zM19 3v16l-7-8z"},
    {"media-seek-forward", "M4 3v16l8-8zM12 3v16l8-8z"},
    {"media-skip-forward", "M17 3h2v16h-2zM10 3v16l7-8zM3 3v16l7-8z"},
    {"document-open", "M2 4h7l2 2h9v12H2zM4 8v8h14V8z"},
    {"document-save", "M3 3h13l3 3v13H3zM7 4v5h7V4zM6 12v6h10v-6z"},
    {"edit-undo", "M3 9l6-5v3h5a5 5 0 0 1 0 10H7v-2h7a3 3 0 0 0 0-6H9v3z"},
    {"edit-redo", "M19 9l-6-5v3H8a5 5 0 0 0 0 10h7v-2H8a3 3 0 0 1 0-6h5v3z"},
    {"edit-delete", "M5 6h12v2H5zM6 9h10v10H6zM9 3h4v2H9z"},
    {"edit-select", "M5 2l12 10-5 1 3 6-3 1-3-6-4 3z"},
    {"starred-symbolic", "M11 2l2.7 6 6.3.6-4.8 4.3 1.4 6.3L11 16l-5.6 3.2 1.4-6.3L2 8.6 8.3 8z"},
    {"arrow-right-double", "M4 4l7 7-7 7zM11 4l7 7-7 7z"},
    {"arrow-down-double", "M4 4l7 7 7-7zM4 11l7 7 7-7z"},
    {"list-add", "M10 3h2v7h7v2h-7v7h-2v-7H3v-2h7z"},
    {"draw-text", "M4 4h14v4h-2V6h-4v11h2v2H8v-2h2V6H6v2H4z"},
    {"draw-arrow", "M3 17.6L15 5.6V9h2V2.5h-6.5v2h3.1L1.6 16.2z"},
    {"draw-circle", "M11 2a9 9 0 1 1 0 18 9 9 0 0 1 0-18zM11 4a7 7 0 1 0 0 14 7 7 0 0 0 0-14z"},
    {"zoom-fit-best", "M2 2h6v2H4v4H2zM14 2h6v6h-2V4h-4zM2 14h2v4h4v2H2zM18 14h2v6h-6v-2h4z"},
};

/// A plain drawing (SVG, 22 × 22, black) for the icons without which a tool bar would be blank;
/// for any other name a small square, so that a button is never empty.
QByteArray fallbackIcon(const QString& name) {
  const char* path = "M8 8h6v6H8z";
  for (const Drawing& drawing : drawings) {
    if (name == QLatin1String(drawing.name)) path = drawing.path;
  }
  return QByteArray(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 22 22\">"
             "<path fill-rule=\"evenodd\" d=\"") +
         path + "\"/></svg>";
}

QByteArray svgOf(const QString& name) {
  const QStringList roots =
      QStandardPaths::locateAll(QStandardPaths::GenericDataLocation, QStringLiteral("icons/breeze"),
                                QStandardPaths::LocateDirectory);
  for (const QString& root : roots) {
    for (const char* folder : {"actions/22", "actions/16", "devices/22", "status/22", "actions/32",
                               "apps/22", "preferences/22"}) {
      QFile file(root + QLatin1Char('/') + QLatin1String(folder) + QLatin1Char('/') + name +
                 QStringLiteral(".svg"));
      if (file.open(QIODevice::ReadOnly)) return file.readAll();
    }
  }
  return fallbackIcon(name);
}

class ThemedIconEngine : public QIconEngine {
 public:
  explicit ThemedIconEngine(const QString& name)
      : m_renderer(std::make_shared<QSvgRenderer>(svgOf(name))), m_name(name) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State state) override {
    const qreal ratio = painter->device()->devicePixelRatioF();
    QPixmap drawn = draw(rect.size() * ratio, mode, state);
    drawn.setDevicePixelRatio(ratio);
    painter->drawPixmap(rect.topLeft(), drawn);
  }

  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    return draw(size, mode, state);
  }

  QIconEngine* clone() const override { return new ThemedIconEngine(*this); }
  QString key() const override { return QStringLiteral("pitchboard"); }
  QString iconName() override { return m_name; }
  bool isNull() override { return !m_renderer->isValid(); }

 private:
  // Buttons are painted whenever what is beside them changes its size; an icon has one or two
  // sizes.
  QPixmap draw(const QSize& size, QIcon::Mode mode, QIcon::State) {
    const QColor color = mode == QIcon::Disabled ? theme().disabledText : theme().text;
    for (const Drawn& known : m_drawn) {
      if (known.pixmap.size() == size && known.color == color.rgb()) return known.pixmap;
    }
    constexpr std::size_t most = 8;
    if (m_drawn.size() == most) m_drawn.erase(m_drawn.begin());
    m_drawn.push_back({color.rgb(), render(size, color)});
    return m_drawn.back().pixmap;
  }

  QPixmap render(const QSize& size, const QColor& color) const {
    QPixmap pixmap(size);
    pixmap.fill(Qt::transparent);
    if (!m_renderer->isValid()) return pixmap;
    QPainter painter(&pixmap);
    const int side = qMin(size.width(), size.height());
    const QRectF square((size.width() - side) / 2.0, (size.height() - side) / 2.0, side, side);
    m_renderer->render(&painter, square);
    painter.setCompositionMode(QPainter::CompositionMode_SourceIn);
    painter.fillRect(pixmap.rect(), color);
    return pixmap;
  }

  struct Drawn {
    QRgb color = 0;
    QPixmap pixmap;
  };

  std::shared_ptr<QSvgRenderer> m_renderer;
  QString m_name;
  std::vector<Drawn> m_drawn;
};

}  // namespace

QIcon themedIcon(const QString& name) {
  auto engine = std::make_unique<ThemedIconEngine>(name);
  if (engine->isNull()) return QIcon::fromTheme(name);
  return QIcon(engine.release());
}

}  // namespace pitchboard::ui
