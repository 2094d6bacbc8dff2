#include "io/deidentify/identifying_texts.h"

#include <QString>
#include <algorithm>

namespace volumen {

namespace {

// Patient's name, ID, other IDs and names, mother's and birth name, accession number; physicians, operators,
// institution and station.
constexpr std::uint32_t whole[] = {0x00100020, 0x00101000, 0x00080050, 0x00080080, 0x00081010};
constexpr std::uint32_t names[] = {0x00100010, 0x00101001, 0x00101005, 0x00101060, 0x00080090,
                                   0x00081048, 0x00081050, 0x00081060, 0x00081070};
constexpr qsizetype leastLetters = 4;  // shorter parts stand in other words by chance

std::string folded(const std::string& text) {
  return QString::fromStdString(text).toCaseFolded().toStdString();
}

}  // namespace

IdentifyingTexts::IdentifyingTexts(const dicom::DataSet& data, const ConfidentialityProfile& profile) {
  const auto textOf = [&](std::uint32_t tag) {
    const bool stays = profile.actionOf(tag, false) == ProfileAction::keep;
    return stays ? QString() : QString::fromStdString(data.utf8(tag, data.root()));
  };
  const auto add = [&](const QString& text) {
    const QString trimmed = text.trimmed();
    if (trimmed.size() >= leastLetters) texts_.push_back(folded(trimmed.toStdString()));
  };
  for (const std::uint32_t tag : whole)
    for (const QString& value : textOf(tag).split(QLatin1Char('\\'))) add(value);
  for (const std::uint32_t tag : names) {
    QString name = textOf(tag);
    for (const char separator : {'\\', '=', ' '}) name.replace(QLatin1Char(separator), QLatin1Char('^'));
    for (const QString& part : name.split(QLatin1Char('^'))) add(part);
  }
}

bool IdentifyingTexts::isIn(const std::string& text) const {
  if (texts_.empty() || text.empty()) return false;
  const std::string in = folded(text);
  return std::ranges::any_of(texts_,
                             [&](const std::string& one) { return in.find(one) != std::string::npos; });
}

}  // namespace volumen
