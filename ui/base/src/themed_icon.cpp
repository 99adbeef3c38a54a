// SPDX-License-Identifier: GPL-3.0-or-later
// Icons of one colour: the shape comes from the Breeze theme, the colour from our own, at the
// moment of drawing, so that a change of theme needs no new icons.
#include <QApplication>
#include <QDir>
#include <QFile>
#include <QIconEngine>
#include <QPainter>
#include <QStandardPaths>
#include <QSvgRenderer>
#include <memory>
#include <vector>

#include <ui/base/theme.h>

#include "fallback_icons.h"

namespace pitchboard::ui {
namespace {

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
