#include "ui/features/theme.h"

#include <QApplication>
#include <QFile>
#include <QPainter>
#include <QPalette>
#include <QStyleFactory>
#include <QSvgRenderer>

namespace volumen {

namespace {

struct Colours {
  QRgb window, base, button, text, muted, line, accent, onAccent;
};

constexpr Colours dark{0xff1b1e22, 0xff101214, 0xff2a2f36, 0xffd7dce2,
                       0xff8a929c, 0xff3c434c, 0xff4aa3ff, 0xff0b0d0f};
constexpr Colours light{0xffeef0f2, 0xffffffff, 0xffe2e5e9, 0xff1b1e22,
                        0xff666d76, 0xffb4bac2, 0xff0b62c4, 0xffffffff};

QPalette paletteOf(const Colours& c) {
  QPalette p;
  p.setColor(QPalette::Window, c.window);
  p.setColor(QPalette::WindowText, c.text);
  p.setColor(QPalette::Base, c.base);
  p.setColor(QPalette::AlternateBase, c.window);
  p.setColor(QPalette::Text, c.text);
  p.setColor(QPalette::PlaceholderText, c.muted);
  p.setColor(QPalette::Button, c.button);
  p.setColor(QPalette::ButtonText, c.text);
  p.setColor(QPalette::BrightText, c.text);
  p.setColor(QPalette::Highlight, c.accent);
  p.setColor(QPalette::HighlightedText, c.onAccent);
  p.setColor(QPalette::Link, c.accent);
  p.setColor(QPalette::ToolTipBase, c.button);
  p.setColor(QPalette::ToolTipText, c.text);
  p.setColor(QPalette::Mid, c.line);
  p.setColor(QPalette::Light, c.line);
  p.setColor(QPalette::Midlight, c.button);
  p.setColor(QPalette::Dark, QColor(c.base));
  p.setColor(QPalette::Shadow, QColor(0, 0, 0));
  for (QPalette::ColorRole role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    p.setColor(QPalette::Disabled, role, c.muted);
  p.setColor(QPalette::Disabled, QPalette::Highlight, c.line);
  return p;
}

QString sheetOf(const Colours& c, Theme theme) {
  const bool isDark = theme == Theme::dark;
  const auto name = [](QRgb rgb) { return QColor(rgb).name(); };
  return QStringLiteral(
             "QToolTip { color: %1; background: %2; border: 1px solid %3; padding: 4px; }"
             "QMainWindow::separator { background: %4; width: 4px; height: 4px; }"
             "QMainWindow::separator:hover { background: %5; }"
             "QDockWidget { font-weight: bold; }"
             "QWidget#foldTitle { background: %2; }"
             "QMainWindow QTabBar::tab { padding: 3px 7px; }"
             "QMainWindow QTabBar { qproperty-elideMode: ElideNone; qproperty-usesScrollButtons: true; }"
             "QToolButton[popupMode=\"2\"] { padding-right: 14px; }"
             "QToolButton::menu-indicator { subcontrol-origin: padding; subcontrol-position: center right; }"
             "QToolBar { border: 0; border-bottom: 1px solid %3; padding: 3px 6px; spacing: 1px; }"
             "QToolButton[onPicture=\"true\"] { color: #d7dce2; background: rgba(27,30,34,200);"
             " border: 1px solid #3c434c; border-radius: 3px; font-weight: bold; }"
             "QToolButton[onPicture=\"true\"]:hover { background: #2b6cb0; color: white; }"
             "QToolButton[onPicture=\"true\"]:focus { border-color: %5; }"
             "QTreeView, QListView { border: 1px solid %3; }"
             "QTreeView::item, QListView::item { padding: 3px 2px; }"
             "QStatusBar::item { border: 0; }"
             "QDockWidget QToolButton:checked { color: %10; background: %5; border: 1px solid %5;"
             " border-radius: 2px; padding: 1px; }"
             "QCheckBox::indicator, QAbstractItemView::indicator { width: 14px; height: 14px;"
             " border: 1px solid %6; border-radius: 3px; background: %7; }"
             // Covers the style's own box, which ignores the padding of items.
             "QAbstractItemView::indicator { left: -2px; }"
             "QCheckBox::indicator:checked { border-color: %5; background: %5; image: "
             "url(:/icons/check-%8.svg); }"
             // The accent colour would be invisible on a selected row.
             "QAbstractItemView::indicator:checked { image: url(:/icons/check-%9.svg); }"
             "QCheckBox::indicator:focus { border-color: %5; }"
             "QAbstractItemView::indicator:disabled { border-color: %3; }"
             "QCheckBox::indicator:disabled { border-color: %3; background: %3; }")
      .arg(name(c.text), name(c.button), name(c.line), name(c.window), name(c.accent), name(c.muted),
           name(c.base), isDark ? QStringLiteral("dark") : QStringLiteral("light"),
           isDark ? QStringLiteral("light") : QStringLiteral("dark"), name(c.onAccent));
}

}  // namespace

void applyTheme(QApplication& app, Theme theme, int textPercent) {
  static const QFont systemFont = QApplication::font();
  const Colours& colours = theme == Theme::dark ? dark : light;
  QFont font = systemFont;
  font.setPointSizeF(systemFont.pointSizeF() * textPercent / 100);
  QApplication::setFont(font);
  app.setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
  app.setPalette(paletteOf(colours));
  app.setStyleSheet(sheetOf(colours, theme));
}

QIcon icon(const QString& name) {
  QFile file(QStringLiteral(":/icons/%1.svg").arg(name));
  if (!file.open(QIODevice::ReadOnly)) return {};
  const QPalette palette = QApplication::palette();
  const QByteArray svg = file.readAll();
  QIcon made;
  for (auto [mode, group] :
       {std::pair(QIcon::Normal, QPalette::Active), std::pair(QIcon::Disabled, QPalette::Disabled)}) {
    QByteArray coloured = svg;
    coloured.replace("currentColor", palette.color(group, QPalette::ButtonText).name().toLatin1());
    QSvgRenderer renderer(coloured);
    for (int size : {22, 44}) {
      QPixmap pixmap(size, size);
      pixmap.fill(Qt::transparent);
      QPainter painter(&pixmap);
      renderer.render(&painter);
      made.addPixmap(pixmap, mode);
    }
  }
  return made;
}

}  // namespace volumen
