#include "io/deidentify/identifying_texts.h"

#include <QStringList>
#include <algorithm>

namespace volumen {

namespace {

// `whole` are looked for as one: patient ID, other IDs, accession number, institution and station.
// `names` are the names of the patient, the mother, physicians and operators.
constexpr std::uint32_t whole[] = {0x00100020, 0x00101000, 0x00080050, 0x00080080, 0x00081010};
constexpr std::uint32_t names[] = {0x00100010, 0x00101001, 0x00101005, 0x00101060, 0x00080090,
                                   0x00081048, 0x00081050, 0x00081060, 0x00081070};
// Shorter parts occur in other texts by chance. Only long ones are looked for inside longer words.
constexpr qsizetype leastLetters = 4, leastOfFamily = 3, leastOfWhole = 3, leastIdeographs = 2,
                    leastInWords = 6;

bool hasIdeographs(const QString& text) { return std::ranges::any_of(text, isIdeographic); }

QStringList wordsOfName(QString name) {
  name.replace(QLatin1Char('-'), QLatin1Char(' '));
  return name.simplified().split(QLatin1Char(' '), Qt::SkipEmptyParts);
}

// Returns the family name, the given name and so on. Many writers separate the two by a blank or a comma
// instead of ^.
QStringList componentsOf(const QString& group) {
  const QStringList components = group.split(QLatin1Char('^'));
  if (components.size() > 1) return components;
  const QStringList words = wordsOfName(QString(group).replace(QLatin1Char(','), QLatin1Char(' ')));
  return words.size() == 2 ? words : components;
}

bool isNameIn(const FoldedText& text, const QString& name, bool isInWords, bool isParted) {
  for (qsizetype at = text.letters().indexOf(name); at >= 0; at = text.letters().indexOf(name, at + 1)) {
    const qsizetype end = at + name.size();
    bool hasParts = false;
    for (qsizetype n = at + 1; n < end; ++n) hasParts = hasParts || text.isBoundary(n);
    const bool isApart = text.isBoundary(at) && text.isBoundary(end);
    if (isApart ? hasParts || !isParted : isInWords && !hasParts) return true;
  }
  return false;
}

bool isIdIn(const FoldedText& text, const QString& id, bool isInWords) {
  for (qsizetype at = text.letters().indexOf(id); at >= 0; at = text.letters().indexOf(id, at + 1))
    if (isInWords || (text.isBoundary(at) && text.isBoundary(at + id.size()))) return true;
  return false;
}

}  // namespace

IdentifyingTexts::IdentifyingTexts(const dicom::DataSet& data, const ConfidentialityProfile& profile) {
  const auto valuesOf = [&](std::uint32_t tag) {
    const bool stays = profile.actionOf(tag, false) == ProfileAction::keep;
    return stays ? QStringList()
                 : QString::fromStdString(data.utf8(tag, data.root())).split(QLatin1Char('\\'));
  };
  for (const std::uint32_t tag : whole)
    for (const QString& value : valuesOf(tag)) addId(value.trimmed());
  for (const std::uint32_t tag : names)
    for (const QString& value : valuesOf(tag))
      for (const QString& group : value.split(QLatin1Char('='))) addName(group);
}

void IdentifyingTexts::addId(const QString& id) {
  if (id.size() < leastLetters) return;
  texts_.push_back(id.toCaseFolded());
  Name folded{FoldedText(id, Umlauts::spelled).letters(), FoldedText(id, Umlauts::dropped).letters()};
  const auto digits = std::ranges::count_if(folded.dropped, [](QChar c) { return c.isDigit(); });
  const bool isLong = folded.dropped.size() >= leastInWords, isNumber = digits == folded.dropped.size();
  // Few digits with signs between them could be any number.
  if (folded.dropped.size() < leastLetters || (isNumber && !isLong)) return;
  folded.isInWords = isLong && digits > 0 && !isNumber;
  ids_.push_back(folded);
}

void IdentifyingTexts::addName(const QString& name) {
  const QStringList components = componentsOf(name);
  const QString family = components.value(0), given = components.value(1), middle = components.value(2);
  const QString first = wordsOfName(given).value(0);
  for (const QStringList& order :
       {components, QStringList{family, given}, QStringList{given, family},
        QStringList{given, middle, family}, QStringList{first, family}, QStringList{family, first}})
    addWhole(order);
  addPart(family, true);
  for (const QString& component : components)
    for (const QString& word : wordsOfName(component)) addPart(word, false);
}

void IdentifyingTexts::addWhole(const QStringList& parts) {
  const auto isThere = [](const QString& part) {
    return !FoldedText(part, Umlauts::spelled).letters().isEmpty();
  };
  if (std::ranges::count_if(parts, isThere) < 2) return;
  const QString all = parts.join(QLatin1Char(' '));
  Name name{FoldedText(all, Umlauts::spelled).letters(), FoldedText(all, Umlauts::dropped).letters()};
  // Two joined initials could be any word.
  name.isParted = name.dropped.size() < leastOfWhole && !hasIdeographs(name.dropped);
  names_.push_back(name);
}

void IdentifyingTexts::addPart(const QString& part, bool isFamily) {
  Name name{FoldedText(part, Umlauts::spelled).letters(), FoldedText(part, Umlauts::dropped).letters()};
  const qsizetype least = !isFamily                     ? leastLetters
                          : hasIdeographs(name.dropped) ? leastIdeographs
                                                        : leastOfFamily;
  if (name.dropped.size() < least) return;
  name.isInWords = name.dropped.size() >= leastInWords;
  names_.push_back(name);
}

bool IdentifyingTexts::isIn(const std::string& text) const {
  if (text.empty() || (texts_.empty() && names_.empty())) return false;
  const QString in = QString::fromStdString(text), inLowerCase = in.toCaseFolded();
  if (std::ranges::any_of(texts_, [&](const QString& one) { return inLowerCase.contains(one); })) return true;
  const FoldedText spelled(in, Umlauts::spelled), dropped(in, Umlauts::dropped);
  const bool hasId = std::ranges::any_of(ids_, [&](const Name& id) {
    return isIdIn(spelled, id.spelled, id.isInWords) || isIdIn(dropped, id.dropped, id.isInWords);
  });
  return hasId || std::ranges::any_of(names_, [&](const Name& name) {
           return isNameIn(spelled, name.spelled, name.isInWords, name.isParted) ||
                  isNameIn(dropped, name.dropped, name.isInWords, name.isParted);
         });
}

}  // namespace volumen
