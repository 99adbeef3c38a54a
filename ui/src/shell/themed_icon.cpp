// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/theme.h>

#include <QFile>
#include <QIconEngine>
#include <QPainter>
#include <QStandardPaths>
#include <QSvgRenderer>
#include <memory>

namespace pitchboard::ui {
namespace {

/// Breeze has each icon in several sizes; the one drawn for toolbars scales best.
QString breezeFile(const QString& name) {
  for (const QString& size : {QStringLiteral("22"), QStringLiteral("16"), QStringLiteral("32")}) {
    const QString file =
        QStandardPaths::locate(QStandardPaths::GenericDataLocation,
                               QStringLiteral("icons/breeze/actions/%1/%2.svg").arg(size, name));
    if (!file.isEmpty()) return file;
  }
  return {};
}

/// Draws one monochrome SVG in the text colour that the theme has at the time of drawing.
class ThemedIconEngine final : public QIconEngine {
 public:
  explicit ThemedIconEngine(const QString& name) : m_name(name) {
    const QString file = breezeFile(name);
    if (!file.isEmpty()) m_svg = std::make_shared<QSvgRenderer>(file);
  }

  QIconEngine* clone() const override { return new ThemedIconEngine(*this); }

  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    QPixmap image(size);
    image.fill(Qt::transparent);
    QPainter painter(&image);
    draw(painter, QRect(QPoint(), size), mode, state);
    return image;
  }

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State state) override {
    const qreal ratio = painter->device()->devicePixelRatioF();
    QPixmap image = pixmap(rect.size() * ratio, mode, state);
    image.setDevicePixelRatio(ratio);
    painter->drawPixmap(rect.topLeft(), image);
  }

 private:
  void draw(QPainter& painter, const QRect& rect, QIcon::Mode mode, QIcon::State state) {
    const ThemeColors& colors = theme();
    QColor color = mode == QIcon::Disabled ? colors.disabledText : colors.text;
    if (state == QIcon::On && mode != QIcon::Disabled && isDarkTheme()) color = Qt::white;
    painter.setRenderHint(QPainter::Antialiasing);
    if (m_svg && m_svg->isValid()) {
      m_svg->render(&painter, rect);
      painter.setCompositionMode(QPainter::CompositionMode_SourceIn);
      painter.fillRect(rect, color);
      return;
    }
    // Without the icon package a button still says what it is: by its first letter.
    painter.setPen(color);
    QFont font = painter.font();
    font.setPixelSize(rect.height() * 3 / 4);
    painter.setFont(font);
    painter.drawText(rect, Qt::AlignCenter, m_name.left(1).toUpper());
  }

  QString m_name;
  std::shared_ptr<QSvgRenderer> m_svg;
};

}  // namespace

QIcon themedIcon(const QString& name) { return QIcon(new ThemedIconEngine(name)); }

}  // namespace pitchboard::ui
