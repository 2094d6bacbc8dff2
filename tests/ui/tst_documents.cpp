// Guards that documents come with the program: Help opens them, and every link and picture in them has a
// target.
#include <QListWidget>
#include <QTextBlock>
#include <QTextBrowser>

#include "tests/ui/journey.h"
#include "tests/unit/suite.h"

using namespace volumen;

class TestDocuments : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void f1OpensThem();
  void linksLeadToPages();
  void picturesAreThere();
};

namespace {

QDialog* opened(tests::Journey& journey) {
  if (!QTest::qWaitForWindowActive(&journey.window)) return nullptr;
  QTest::keyClick(&journey.window, Qt::Key_F1);
  return journey.child<QDialog>("documents");
}

// Returns the values of a property of the text formats in a document.
QStringList inText(const QTextDocument& document, const std::function<QString(const QTextCharFormat&)>& of) {
  QStringList out;
  for (QTextBlock block = document.begin(); block.isValid(); block = block.next())
    for (auto it = block.begin(); !it.atEnd(); ++it)
      if (const QString found = of(it.fragment().charFormat()); !found.isEmpty()) out << found;
  return out;
}

}  // namespace

void TestDocuments::f1OpensThem() {
  tests::Journey journey;
  QDialog* documents = opened(journey);
  QVERIFY(documents);
  auto* list = documents->findChild<QListWidget*>(QStringLiteral("documentList"));
  auto* text = documents->findChild<QTextBrowser*>(QStringLiteral("documentText"));
  QVERIFY(list->count() >= 7);
  for (int n = 0; n < list->count(); ++n) {
    const QPoint row = list->visualItemRect(list->item(n)).center();
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, row);
    QVERIFY2(text->toPlainText().startsWith(list->item(n)->text()), qPrintable(list->item(n)->text()));
  }
}

void TestDocuments::linksLeadToPages() {
  tests::Journey journey;
  QDialog* documents = opened(journey);
  QVERIFY(documents);
  auto* list = documents->findChild<QListWidget*>(QStringLiteral("documentList"));
  auto* text = documents->findChild<QTextBrowser*>(QStringLiteral("documentText"));
  int links = 0;
  for (int n = 0; n < list->count(); ++n) {
    list->setCurrentRow(n);
    const QStringList targets =
        inText(*text->document(), [](const QTextCharFormat& f) { return f.anchorHref(); });
    for (const QString& target : targets) {
      ++links;
      QVERIFY2(QFile::exists(QStringLiteral(":/docs/") + target), qPrintable(target));
      Q_EMIT text->anchorClicked(QUrl(target));
      QCOMPARE(text->source().fileName(), target);
      list->setCurrentRow(n);
    }
  }
  QVERIFY(links > 0);
}

void TestDocuments::picturesAreThere() {
  tests::Journey journey;
  QDialog* documents = opened(journey);
  QVERIFY(documents);
  auto* list = documents->findChild<QListWidget*>(QStringLiteral("documentList"));
  auto* text = documents->findChild<QTextBrowser*>(QStringLiteral("documentText"));
  int pictures = 0;
  for (int n = 0; n < list->count(); ++n) {
    list->setCurrentRow(n);
    const QStringList names = inText(*text->document(), [](const QTextCharFormat& f) {
      return f.isImageFormat() ? f.toImageFormat().name() : QString();
    });
    for (const QString& name : names) {
      ++pictures;
      const QUrl whole = text->source().resolved(QUrl(name));
      QVERIFY2(QFile::exists(QLatin1Char(':') + whole.path()), qPrintable(whole.toString()));
    }
  }
  QVERIFY(pictures > 0);
}

VOLUMEN_TEST(TestDocuments);
#include "tst_documents.moc"
