#include "ui/panels/picture_dialog.h"

#include <QFormLayout>
#include <algorithm>
#include <cstdlib>

#include "results/text/text.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

constexpr int widestPicture = 8192, widestOfSheet = 800, mostSheetRows = 12;

// Sizes in the order of the box.
constexpr PictureLook::Size sizeChoices[] = {PictureLook::Size::asSeen, PictureLook::Size::own,
                                             PictureLook::Size::wide};

QString titleOf(PicturesOf of) {
  switch (of) {
    case PicturesOf::view:
      return PictureDialog::tr("Picture of any size");
    case PicturesOf::stack:
      return PictureDialog::tr("Stack as pictures");
    case PicturesOf::sheet:
      return PictureDialog::tr("Contact sheet");
    case PicturesOf::film:
    case PicturesOf::turn:
      break;
  }
  return PictureDialog::tr("Film");
}

}  // namespace

QCheckBox* hideNamesField(const QString& name) {
  auto* field = flagField({name, tr("Hide names, IDs and dates")});
  field->setChecked(namesHidden());
  field->setEnabled(!namesHidden());
  return field;
}

PictureDialog::PictureDialog(PicturesOf of, Stack stack, QSize seen, QWidget* parent, int timePoints)
    : QDialog(parent),
      of_(of),
      stack_(std::move(stack)),
      timePoints_(countedStack(tr("Time point"), {0, timePoints})),
      seen_(seen),
      form_(new QFormLayout(this)) {
  setObjectName(QStringLiteral("picturesDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(titleOf(of));
  addSize();
  addFilm(timePoints);
  addNumbers(std::max(1, stack_.numberCount));
  addTexts();
  addButtons();
  showCount();
}

QSpinBox* PictureDialog::number(const char* name, const QString& label, int least, int most, int value,
                                bool isShown) {
  auto* box = wholeField({QLatin1String(name), label}, least, most);
  box->setValue(value);
  form_->addRow(label, box);
  form_->setRowVisible(box, isShown);
  connect(box, &QSpinBox::valueChanged, this, &PictureDialog::showCount);
  return box;
}

void PictureDialog::addSize() {
  const bool isSheet = of_ == PicturesOf::sheet, isTurn = of_ == PicturesOf::turn;
  size_ =
      choiceField({QStringLiteral("pictureSize"), tr("Size")},
                  {tr("As on screen"), tr("All of it at its own pixels"), tr("As on screen, of this width")});
  form_->addRow(size_->accessibleName(), size_);
  width_ = number("pictureWidth", isSheet ? tr("Width of a picture") : tr("Width"), 50,
                  isSheet ? widestOfSheet : widestPicture,
                  isSheet  ? 256
                  : isTurn ? seen_.width()
                           : 2 * seen_.width(),
                  true);
  width_->setSuffix(tr(" px"));
  const auto follow = [this] {
    width_->setEnabled(sizeChoices[size_->currentIndex()] == PictureLook::Size::wide);
  };
  connect(size_, &QComboBox::currentIndexChanged, this, follow);
  if (isSheet || isTurn) {
    size_->setCurrentIndex(2);
    form_->setRowVisible(size_, false);
  }
  follow();
}

void PictureDialog::addFilm(int timePoints) {
  const bool isTurn = of_ == PicturesOf::turn;
  filmOf_ = choiceField({QStringLiteral("filmOf"), tr("What")},
                        {isTurn ? tr("A full turn") : tr("All of the stack"), tr("Time points")});
  filmFormat_ = choiceField({QStringLiteral("filmFormat"), tr("Format")},
                            {tr("Animated PNG"), tr("MP4 (needs the package ffmpeg)")});
  form_->addRow(filmOf_->accessibleName(), filmOf_);
  form_->addRow(filmFormat_->accessibleName(), filmFormat_);
  form_->setRowVisible(filmOf_, timePoints > 1);
  form_->setRowVisible(filmFormat_, isFilm());
  turnPictures_ = number("filmPictures", tr("Pictures of the turn"), 2, 999, 36, isTurn);
  perSecond_ = number("filmPerSecond", tr("Pictures a second"), 1, 100, 10, isFilm());
  connect(filmOf_, &QComboBox::currentIndexChanged, this, [this, timePoints] { followFilmOf(timePoints); });
}

void PictureDialog::followFilmOf(int timePoints) {
  offerNumbers(isOfTimePoints() ? timePoints : std::max(1, stack_.numberCount));
  if (of_ != PicturesOf::turn) return;
  form_->setRowVisible(turnPictures_, !isOfTimePoints());
  for (QSpinBox* box : {first_, last_, every_}) form_->setRowVisible(box, isOfTimePoints());
  form_->setRowVisible(count_, isOfTimePoints());
}

void PictureDialog::offerNumbers(int count) {
  for (QSpinBox* box : {first_, last_, every_}) box->setMaximum(count);
  for (QSpinBox* box : {first_, last_}) box->setSuffix(tr(" of %1").arg(count));
  first_->setValue(1);
  last_->setValue(count);
}

void PictureDialog::addNumbers(int count) {
  const bool isSheet = of_ == PicturesOf::sheet;
  const bool isStack = of_ == PicturesOf::stack || of_ == PicturesOf::film, isRange = isSheet || isStack;
  first_ = number("pictureFirst", tr("From"), 1, count, 1, isRange);
  last_ = number("pictureLast", tr("To"), 1, count, count, isRange);
  every_ = number("pictureEvery", tr("Every"), 1, count, 1, isStack);
  offerNumbers(count);
  every_->setToolTip(toolTipOf(tr("1: each of them; 3: every third one")));
  rows_ = number("sheetRows", tr("Rows"), 1, mostSheetRows, 4, isSheet);
  columns_ = number("sheetColumns", tr("Columns"), 1, mostSheetRows, 5, isSheet);
}

void PictureDialog::addTexts() {
  texts_ = flagField({QStringLiteral("pictureTexts"), of_ == PicturesOf::sheet
                                                          ? tr("Texts above, a number on each picture")
                                                          : tr("Texts, lines and measurements")});
  texts_->setChecked(true);
  hideNames_ = hideNamesField(QStringLiteral("pictureHideNames"));
  connect(texts_, &QCheckBox::toggled, this,
          [this](bool on) { hideNames_->setEnabled(on && !namesHidden()); });
  form_->addRow(texts_);
  form_->addRow(hideNames_);
  form_->setRowVisible(hideNames_, !isFilm());
}

void PictureDialog::addButtons() {
  count_ = plainLabel();
  count_->setObjectName(QStringLiteral("pictureCount"));
  form_->addRow(count_);
  form_->setRowVisible(count_, of_ != PicturesOf::view && of_ != PicturesOf::turn);
  auto* buttons = new QDialogButtonBox;
  save_ = addAccept(*this, *buttons, QStringLiteral("pictureSave"), tr("Save..."));
  form_->addRow(buttons);
}

PictureLook PictureDialog::look() const {
  PictureLook look;
  look.size = sizeChoices[size_->currentIndex()];
  look.edge = width_->value();
  look.seen = seen_;
  look.withTexts = texts_->isChecked() && of_ != PicturesOf::sheet;
  look.namesHidden = isFilm() || hideNames_->isChecked();
  return look;
}

QString PictureDialog::filmEnding() const {
  return filmFormat_->currentIndex() == 0 ? QStringLiteral(".png") : QStringLiteral(".mp4");
}

// Returns every how many positions are used. A sheet skips as few as its room allows.
int PictureDialog::every() const {
  if (of_ != PicturesOf::sheet) return every_->value();
  const int count = std::abs(last_->value() - first_->value()) + 1, room = rows_->value() * columns_->value();
  return (count + room - 1) / room;
}

std::vector<std::pair<int, int>> PictureDialog::places() const {
  const auto [from, to] = std::minmax({first_->value(), last_->value()});
  const Stack& stack = isOfTimePoints() ? timePoints_ : stack_;
  std::vector<std::pair<int, int>> places;
  for (int number = from; number <= to; number += every())
    if (const std::optional<int> place = stack.placeOf(number)) places.emplace_back(number, *place);
  return places;
}

void PictureDialog::showCount() {
  const int pictures = int(places().size());
  const QString text = pictures == 1 ? tr("1 picture") : tr("%1 pictures").arg(pictures);
  save_->setEnabled(of_ == PicturesOf::view || of_ == PicturesOf::turn || pictures > 0);
  count_->setText(every() == 1 ? text : tr("%1, every %2.").arg(text).arg(every()));
}

}  // namespace volumen
