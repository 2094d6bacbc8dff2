// Guards the text of window numbers and of long numbers.
#include "results/text/value_text.h"
#include "tests/unit/suite.h"

using namespace volumen;

class TestValueText : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void windowsRead_data();
  void windowsRead();
  void digitsRead_data();
  void digitsRead();
};

void TestValueText::windowsRead_data() {
  QTest::addColumn<double>("width");
  QTest::addColumn<double>("centre");
  QTest::addColumn<QString>("text");
  const auto row = [](double width, double centre, const char* text) {
    QTest::newRow(text) << width << centre << QString::fromLatin1(text);
  };
  row(400, 40, "W 400 L 40");
  row(400, -600, "W 400 L -600");
  row(255, 127.5, "W 255.0 L 127.5");
  row(12.7423, 6.37115, "W 12.74 L 6.37");
  row(65536, 32768, "W 65536 L 32768");
  row(1234567, -7654321, "W 1234567 L -7654321");
  row(32.5, 1024, "W 32.5 L 1024.0");
  row(0.5, 0.25, "W 0.50 L 0.25");
  row(0.01234567, 0.5, "W 0.01235 L 0.50000");
  row(2.5e-7, 1e-7, "W 2.5e-07 L 1e-07");
  row(3e12, 1.5e12, "W 3e+12 L 1.5e+12");
}

void TestValueText::windowsRead() {
  QFETCH(double, width);
  QFETCH(double, centre);
  QTEST(windowText({centre, width}, {}), "text");
}

void TestValueText::digitsRead_data() {
  QTest::addColumn<double>("number");
  QTest::addColumn<QString>("text");
  const auto row = [](double number, const char* text) {
    QTest::newRow(text) << number << QString::fromLatin1(text);
  };
  row(0.012345678, "0.012346");
  row(-3.25, "-3.25");
  row(99999.4, "99999");
  row(99999.5, "100000");
  row(943761.2, "943761");
  row(-27141234, "-27141234");
  row(3e15, "3e+15");
}

void TestValueText::digitsRead() {
  QFETCH(double, number);
  QTEST(digitsText(number, 5), "text");
}

VOLUMEN_TEST(TestValueText);
#include "tst_value_text.moc"
