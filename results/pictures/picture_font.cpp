#include "results/pictures/picture_font.h"

#include <QFontDatabase>
#include <QStringList>

// Outside the namespace, as Qt demands.
static void loadFontFiles() { Q_INIT_RESOURCE(fonts); }

namespace volumen {

namespace {

constexpr double screenPoints = 9, morePoints = 2;  // text size; letters are larger by `morePoints`

QString familyIn(const QString& file) {
  const int id = QFontDatabase::addApplicationFont(QStringLiteral(":/fonts/") + file);
  return QFontDatabase::applicationFontFamilies(id).value(0);
}

struct Families {
  QString text, letters;
};

const Families& families() {
  static const Families loaded = [] {
    loadFontFiles();
    familyIn(QStringLiteral("DejaVuSans-Bold.ttf"));
    return Families{familyIn(QStringLiteral("DejaVuSans.ttf")),
                    familyIn(QStringLiteral("DejaVuSansMono-Bold.ttf"))};
  }();
  return loaded;
}

// Desktop settings (hinting, subpixel colours) must not change pictures.
QFont drawnAlike(QFont font) {
  font.setHintingPreference(QFont::PreferVerticalHinting);
  font.setStyleStrategy(QFont::NoSubpixelAntialias);
  return font;
}

}  // namespace

QFont pictureFont(int percent) {
  QFont font(families().text);
  font.setPointSizeF(screenPoints * percent / 100);
  return drawnAlike(font);
}

QFont letterFont(const QFont& font) {
  QFont letters(families().letters);
  letters.setPointSizeF(font.pointSizeF() + morePoints);
  letters.setBold(true);
  return drawnAlike(letters);
}

}  // namespace volumen
