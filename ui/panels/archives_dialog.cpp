#include "ui/panels/archives_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLineEdit>
#include <QListWidget>
#include <QSignalBlocker>
#include <QSpinBox>

#include "io/archive/search_archive.h"
#include "io/files/output_file.h"
#include "io/files/preset_files.h"
#include "io/files/private_folder.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

Status written(const Archives& archives) {
  if (Status made = makePrivateFolder(configFolder()); !made) return made;
  return writeWholeFile(userArchivesFile(), archivesToJson(archives));
}

}  // namespace

ArchivesDialog::ArchivesDialog(JobLane& tests, QWidget* parent)
    : QDialog(parent),
      list_(new QListWidget),
      fields_(new QWidget),
      form_(new QFormLayout(fields_)),
      kind_(choiceField({QStringLiteral("archiveKind"), tr("Protocol")}, {tr("DIMSE"), tr("DICOMweb")})),
      port_(wholeField({QStringLiteral("archivePort"), tr("Port")}, 1, 65535)),
      told_(wrappedLabel(QStringLiteral("archiveTold"))),
      tests_(tests) {
  setObjectName(QStringLiteral("archivesDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(tr("Archives"));
  resize(700, 320);
  list_->setObjectName(QStringLiteral("archiveList"));
  list_->setAccessibleName(tr("Archives"));
  fillForm();
  auto* add = buttonOf<QPushButton>(QStringLiteral("addArchive"), tr("Add"), [this] { this->add(); });
  auto* remove =
      buttonOf<QPushButton>(QStringLiteral("removeArchive"), tr("Remove"), [this] { this->remove(); });
  auto* left = new QVBoxLayout;
  left->addWidget(list_, 1);
  left->addLayout(lineOf({add, remove}));
  auto* both = new QHBoxLayout;
  both->addLayout(left, 1);
  both->addWidget(fields_, 2);
  stack(this, {both, told_}, 12, 8);
  makeButtons();
  const Result<Archives> read = readArchives(userArchivesFile());
  if (read) archives_ = asRead_ = *read;
  for (const Archive& archive : archives_.archives) list_->addItem(QString::fromStdString(archive.name));
  connect(list_, &QListWidget::currentRowChanged, this, &ArchivesDialog::showChosen);
  list_->setCurrentRow(0);
  showChosen();
  if (read) return;
  told_->setText(QString::fromStdString(read.message()));
  for (auto* button : findChildren<QPushButton*>())
    if (button->objectName() != QStringLiteral("cancelArchives")) button->setEnabled(false);
}

ArchivesDialog::~ArchivesDialog() { tests_.giveUpAll(); }

QLineEdit* ArchivesDialog::addText(const char* word, const QString& label, std::string Archive::*member,
                                   std::optional<ArchiveKind> kind) {
  auto* field = new QLineEdit;
  field->setObjectName(QStringLiteral("archive_") + QLatin1String(word));
  field->setProperty("word", QLatin1String(word));
  field->setAccessibleName(label);
  form_->addRow(label, field);
  texts_.emplace_back(field, member);
  if (kind) ofKind_.emplace_back(field, *kind);
  connect(field, &QLineEdit::textEdited, this, [this, member](const QString& text) {
    Archive* archive = chosen();
    if (!archive) return;
    archive->*member = text.trimmed().toStdString();
    list_->currentItem()->setText(QString::fromStdString(archive->name));
  });
  return field;
}

void ArchivesDialog::fillForm() {
  constexpr ArchiveKind dimse = ArchiveKind::dimse, web = ArchiveKind::dicomweb;
  form_->setContentsMargins(0, 0, 0, 0);
  addText("name", tr("Name"), &Archive::name);
  form_->addRow(tr("Protocol"), kind_);
  addText("host", tr("Host or address"), &Archive::host, dimse);
  form_->addRow(tr("Port"), port_);
  ofKind_.emplace_back(port_, dimse);
  addText("calledAe", tr("AE title of the archive"), &Archive::calledAe, dimse);
  addText("callingAe", tr("AE title of this program"), &Archive::callingAe, dimse);
  addText("url", tr("URL"), &Archive::url, web);
  addText("user", tr("User"), &Archive::user, web);
  const auto addCommand = [this](const char* word, const QString& label, std::string Archive::*member,
                                 const QString& tip) {
    QLineEdit* field = addText(word, label, member, ArchiveKind::dicomweb);
    field->setPlaceholderText(tr("such as: secret-tool lookup archive main"));
    field->setToolTip(toolTipOf(tip));
  };
  addCommand("passwordCommand", tr("Password command"), &Archive::passwordCommand,
             tr("Prints the password. The program keeps the command, not the password."));
  addCommand("tokenCommand", tr("Token command"), &Archive::tokenCommand,
             tr("Prints a bearer token, in place of user and password"));
  form_->addRow(buttonOf<QPushButton>(QStringLiteral("testArchive"), tr("Test"), [this] { test(); }));
  connect(kind_, &QComboBox::currentIndexChanged, this, [this](int kind) {
    if (Archive* archive = chosen()) archive->kind = ArchiveKind(kind);
    showFieldsOfKind(ArchiveKind(kind));
  });
  connect(port_, &QSpinBox::valueChanged, this, [this](int port) {
    if (Archive* archive = chosen()) archive->port = port;
  });
}

void ArchivesDialog::showFieldsOfKind(ArchiveKind shown) {
  for (const auto& [field, kind] : ofKind_) form_->setRowVisible(field, kind == shown);
}

void ArchivesDialog::makeButtons() {
  auto* buttons = new QDialogButtonBox;
  auto* cancel = buttons->addButton(QDialogButtonBox::Cancel);
  cancel->setObjectName(QStringLiteral("cancelArchives"));
  auto* save = buttons->addButton(QDialogButtonBox::Save);
  save->setObjectName(QStringLiteral("saveArchives"));
  save->setDefault(true);
  for (auto* other : findChildren<QPushButton*>()) other->setAutoDefault(false);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(save, &QPushButton::clicked, this, &ArchivesDialog::save);
  layout()->addWidget(buttons);
}

Archive* ArchivesDialog::chosen() {
  const int row = list_->currentRow();
  return row < 0 || row >= int(archives_.archives.size()) ? nullptr : &archives_.archives[std::size_t(row)];
}

void ArchivesDialog::showChosen() {
  tests_.giveUpAll();
  told_->clear();
  const Archive* archive = chosen();
  fields_->setEnabled(archive);
  const Archive shown = archive ? *archive : Archive();
  for (const auto& [field, member] : texts_) field->setText(QString::fromStdString(shown.*member));
  const QSignalBlocker port(port_), kind(kind_);
  port_->setValue(shown.port);
  kind_->setCurrentIndex(int(shown.kind));
  showFieldsOfKind(shown.kind);
}

void ArchivesDialog::add() {
  archives_.archives.emplace_back();
  list_->addItem(QString());
  list_->setCurrentRow(list_->count() - 1);
  texts_.front().first->setFocus();
}

void ArchivesDialog::remove() {
  const int row = list_->currentRow();
  if (!chosen()) return;
  archives_.archives.erase(archives_.archives.begin() + row);
  delete list_->takeItem(row);
  showChosen();
}

QString ArchivesDialog::inWords(const std::string& problem) const {
  QString sentence = QString::fromStdString(problem).remove(QStringLiteral("archives[0]."));
  for (const auto& [field, member] : texts_) {
    const QString word = field->property("word").toString(),
                  quoted = QLatin1Char('"') + word + QLatin1Char('"');
    if (sentence.startsWith(word + QLatin1Char(' ')))
      sentence.replace(0, word.size(), field->accessibleName());
    sentence.replace(quoted, QLatin1Char('"') + field->accessibleName() + QLatin1Char('"'));
  }
  return sentence;
}

// Tests the archive as it would be read from the file.
void ArchivesDialog::test() {
  tests_.giveUpAll();
  const Result<Archives> parsed = parseArchives(archivesToJson({{*chosen()}}));
  if (!parsed) return told_->setText(inWords(parsed.message()));
  told_->setText(tr("Testing..."));
  tests_.run(
      {}, [archive = parsed->archives[0]](const Job& job) { return testArchive(archive, job.cancel()); },
      [this, name = parsed->archives[0].name](const Status& answers) {
        told_->setText(answers ? tr("The archive \"%1\" answers.").arg(QString::fromStdString(name))
                               : inWords(answers.message()));
      });
}

// Chooses the first archive that is not valid, and tells why.
bool ArchivesDialog::isValid() {
  for (std::size_t n = 0; n < archives_.archives.size(); ++n) {
    const Result<Archives> parsed = parseArchives(archivesToJson({{archives_.archives[n]}}));
    if (parsed) continue;
    list_->setCurrentRow(int(n));
    told_->setText(inWords(parsed.message()));
    return false;
  }
  const Result<Archives> parsed = parseArchives(archivesToJson(archives_));
  told_->setText(parsed ? QString() : QString::fromStdString(parsed.message()));
  return parsed.ok();
}

void ArchivesDialog::save() {
  if (!isValid()) return;
  if (const Result<Archives> now = readArchives(userArchivesFile()); !now || *now != asRead_)
    return told_->setText(
        tr("Another program has changed the list meanwhile. Close this window and open it again."));
  if (const Status done = written(archives_); !done)
    return told_->setText(QString::fromStdString(done.message()));
  accept();
}

}  // namespace volumen
