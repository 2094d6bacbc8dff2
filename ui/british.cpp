#include "ui/british.h"

#include <QCoreApplication>
#include <QLocale>
#include <QTranslator>

namespace volumen {

namespace {

// Qt has no British translation, so its few American words are replaced here.
class British : public QTranslator {
 public:
  using QTranslator::QTranslator;

  bool isEmpty() const override { return false; }
  QString translate(const char*, const char* text, const char*, int) const override {
    static constexpr std::pair<const char*, const char*> words[] = {
        {"Color", "Colour"}, {"color", "colour"},      {"Gray", "Grey"},
        {"gray", "grey"},    {"Maximize", "Maximise"}, {"Minimize", "Minimise"}};
    QString british = QString::fromUtf8(text);
    bool differs = false;
    for (const auto& [american, word] : words) {
      differs = differs || british.contains(QLatin1String(american));
      british.replace(QLatin1String(american), QLatin1String(word));
    }
    return differs ? british : QString();
  }
};

}  // namespace

void speakBritish(QCoreApplication& app) {
  QLocale::setDefault(QLocale(QLocale::English, QLocale::UnitedKingdom));
  QCoreApplication::installTranslator(new British(&app));
}

}  // namespace volumen
