// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Exceptions in event handlers and in slots.
#include "window/application.h"

#include <QTest>
#include <QTimer>

#include "registered.h"
#include "thrown.h"

namespace transillum::viewer::application_test {

class ApplicationTest : public QObject {
  Q_OBJECT

 public:
  explicit ApplicationTest(Application& application) : application_(application) {}

 private slots:
  void an_exception_becomes_a_message_data() {
    QTest::addColumn<int>("exception");
    QTest::addColumn<QString>("message");
    QTest::newRow("memory") << 0 << "Not enough memory";
    QTest::newRow("named") << 1 << "no such thing";
    QTest::newRow("unknown") << 2 << "Unknown error";
  }
  void an_exception_becomes_a_message() {
    QFETCH(const int, exception);
    QFETCH(const QString, message);
    QStringList messages;
    application_.on_failure = [&](const QString& text) { messages << text; };
    const auto fail = [exception] { throw_kind(exception); };
    bool later = false;
    QTimer::singleShot(0, this, fail);
    QMetaObject::invokeMethod(this, fail, Qt::QueuedConnection);
    QTimer::singleShot(0, this, [&] { later = true; });
    QVERIFY(QTest::qWaitFor([&] { return later && messages.size() == 2; }));
    QCOMPARE(messages, (QStringList{message, message}));
    application_.on_failure = nullptr;
  }

 private:
  Application& application_;
};

const test::Registered registered("application", [](int argc, char** argv) {
  Application application(argc, argv);
  ApplicationTest test(application);
  return QTest::qExec(&test, argc, argv);
});

}  // namespace transillum::viewer::application_test

#include "application_test.moc"
