// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtTest>

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QPainter>

#include <ui/session/video_writer.h>

namespace tst_video_writer {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

QImage pictureOf(int index, QSize size) {
  QImage image(size, QImage::Format_ARGB32_Premultiplied);
  image.fill(QColor(0x33, 0x45, 0x3a));
  QPainter painter(&image);
  painter.fillRect(10 + 2 * index, 20, 40, 40, Qt::white);
  return image;
}

/// Gives every picture when it is wanted.
void feed(VideoWriter& writer, int pictures, QSize size) {
  const auto give = [&writer, pictures, size] {
    while (writer.ready() && writer.pictures() < pictures) {
      writer.add(pictureOf(static_cast<int>(writer.pictures()), size));
    }
    if (writer.pictures() == pictures) writer.finish();
  };
  QObject::connect(&writer, &VideoWriter::wantsPicture, &writer, give);
  give();
}

QJsonObject probe(const QString& path) {
  QProcess process;
  process.start(
      "ffprobe",
      {"-v", "error", "-count_frames", "-show_entries",
       "stream=codec_name,width,height,nb_read_frames,r_frame_rate:format=duration,format_name",
       "-of", "json", path});
  if (!process.waitForFinished(20000)) return {};
  return QJsonDocument::fromJson(process.readAllStandardOutput()).object();
}

}  // namespace

class TestVideoWriter : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;

  /// What a video that is not whole would leave.
  QStringList parts() const {
    return QDir(m_folder.path()).entryList({"*.part"}, QDir::Files | QDir::Hidden);
  }

  QString script(const QString& name, const QByteArray& text) {
    const QString path = m_folder.filePath(name);
    QFile file(path);
    if (!file.open(QIODevice::WriteOnly)) return {};
    file.write("#!/bin/sh\n" + text);
    file.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
    return path;
  }

 private slots:
  void initTestCase() {
    QVERIFY2(!QStandardPaths::findExecutable("ffprobe").isEmpty(),
             "ffmpeg is not installed (scripts/packages-test.txt)");
  }

  void theVideoIsWhatWasDrawn_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("codec");
    QTest::addColumn<QSize>("size");
    QTest::addColumn<QSize>("expected");
    QTest::addColumn<double>("rate");
    QTest::newRow("mp4") << "a.mp4"
                         << "h264" << QSize(320, 200) << QSize(320, 200) << 30.0;
    QTest::newRow("webm") << "a.webm"
                          << "vp9" << QSize(320, 200) << QSize(320, 200) << 30.0;
    QTest::newRow("odd size, upper case") << "odd.MP4"
                                          << "h264" << QSize(321, 201) << QSize(320, 200) << 25.0;
  }
  void theVideoIsWhatWasDrawn() {
    QFETCH(QString, name);
    QFETCH(QString, codec);
    QFETCH(QSize, size);
    QFETCH(QSize, expected);
    QFETCH(double, rate);
    VideoWriter writer;
    QSignalSpy finished(&writer, &VideoWriter::finished), failed(&writer, &VideoWriter::failed);
    const VideoOptions options{m_folder.filePath(name), size, rate, false, "ffmpeg"};
    const auto started = writer.start(options);
    QVERIFY2(started, started ? "" : started.error().text().c_str());
    feed(writer, 50, size);
    QTRY_VERIFY_WITH_TIMEOUT(finished.count() + failed.count() == 1, 60000);
    QVERIFY2(failed.isEmpty(), failed.isEmpty() ? "" : qPrintable(failed[0][0].toString()));
    QCOMPARE(finished[0][0].toString(), options.path);
    QVERIFY(parts().isEmpty());
    const QJsonObject seen = probe(options.path);
    const QJsonObject stream = seen["streams"].toArray().at(0).toObject();
    QCOMPARE(stream["codec_name"].toString(), codec);
    QCOMPARE(QSize(stream["width"].toInt(), stream["height"].toInt()), expected);
    QCOMPARE(stream["nb_read_frames"].toString(), QString("50"));
    const double duration = seen["format"].toObject()["duration"].toString().toDouble();
    QVERIFY2(std::abs(duration - 50 / rate) < 0.06, qPrintable(QString::number(duration)));
    // Never over an existing file, unless told to.
    QCOMPARE(writer.start(options).error().code, ErrorCode::Conflict);
  }

  void cancellingLeavesNothing() {
    VideoWriter writer;
    QSignalSpy finished(&writer, &VideoWriter::finished), failed(&writer, &VideoWriter::failed);
    const VideoOptions options{
        m_folder.filePath("cancelled.mp4"), {320, 200}, 30.0, false, "ffmpeg"};
    QVERIFY(writer.start(options));
    for (int i = 0; i < 10; ++i) writer.add(pictureOf(i, {320, 200}));
    writer.cancel();
    QVERIFY(!writer.isWriting());
    QVERIFY(!QFile::exists(options.path) && parts().isEmpty());
    QVERIFY(finished.isEmpty() && failed.isEmpty());
    // And another one can be made.
    QVERIFY(writer.start(options));
    feed(writer, 5, {320, 200});
    QTRY_COMPARE_WITH_TIMEOUT(finished.count(), 1, 60000);
  }

  void badOptionsAreRefused_data() {
    QTest::addColumn<QString>("path");
    QTest::addColumn<QSize>("size");
    QTest::addColumn<double>("rate");
    QTest::addColumn<QString>("program");
    QTest::addColumn<QString>("words");
    const QString path = m_folder.filePath("b.mp4");
    QTest::newRow("suffix") << m_folder.filePath("b.avi") << QSize(320, 200) << 30.0 << "ffmpeg"
                            << ".webm";
    QTest::newRow("small") << path << QSize(8, 200) << 30.0 << "ffmpeg"
                           << "16 to 8192 pixels";
    QTest::newRow("huge") << path << QSize(320, 20000) << 30.0 << "ffmpeg"
                          << "16 to 8192 pixels";
    QTest::newRow("rate") << path << QSize(320, 200) << 0.0 << "ffmpeg"
                          << "1 to 240";
    QTest::newRow("not installed") << path << QSize(320, 200) << 30.0 << "no-such-ffmpeg"
                                   << "Install";
    QTest::newRow("folder") << "/nonexistent/b.mp4" << QSize(320, 200) << 30.0 << "ffmpeg"
                            << "The folder does not exist";
  }
  void badOptionsAreRefused() {
    QFETCH(QString, path);
    QFETCH(QSize, size);
    QFETCH(double, rate);
    QFETCH(QString, program);
    QFETCH(QString, words);
    VideoWriter writer;
    const auto started = writer.start({path, size, rate, false, program});
    QVERIFY(!started);
    QVERIFY2(QString::fromStdString(started.error().message).contains(words),
             started.error().message.c_str());
    QVERIFY(!QFile::exists(path) && parts().isEmpty());
  }

  void errorsAreSentences_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("words");
    QTest::newRow("disk full")
        << QByteArray("cat >/dev/null; echo 'x.mp4: No space left on device' >&2; exit 1")
        << "the disk is full";
    QTest::newRow("encoder") << QByteArray("echo \"Unknown encoder 'libx264'\" >&2; exit 1")
                             << "cannot write MP4 videos";
    QTest::newRow("other") << QByteArray(
                                  "cat >/dev/null; echo first >&2; echo 'it broke' >&2; exit 3")
                           << "(it broke)";
    QTest::newRow("silent") << QByteArray("exit 1") << "no reason";
    QTest::newRow("killed") << QByteArray("kill -9 $$") << "terminated";
    QTest::newRow("ends early") << QByteArray("exit 0") << "no reason";
  }
  void errorsAreSentences() {
    QFETCH(QByteArray, text);
    QFETCH(QString, words);
    VideoWriter writer;
    QSignalSpy failed(&writer, &VideoWriter::failed);
    const QString path = m_folder.filePath("broken.mp4");
    QVERIFY(writer.start({path, {320, 200}, 30.0, false, script("fake", text)}));
    writer.add(pictureOf(0, {320, 200}));
    if (!words.contains("no reason")) writer.finish();
    QTRY_COMPARE_WITH_TIMEOUT(failed.count(), 1, 20000);
    QVERIFY2(failed[0][0].toString().contains(words), qPrintable(failed[0][0].toString()));
    QVERIFY(!QFile::exists(path) && parts().isEmpty());
  }

  void anOldVideoStaysWhenTheNewOneFails() {
    const QString path = m_folder.filePath("old.mp4");
    QFile old(path);
    QVERIFY(old.open(QIODevice::WriteOnly) && old.write("old") == 3);
    old.close();
    VideoWriter writer;
    QSignalSpy failed(&writer, &VideoWriter::failed);
    VideoOptions options{
        path, {320, 200}, 30.0, true, script("fails", "cat > /dev/null; exit 1\n")};
    QVERIFY(writer.start(options));
    writer.add(pictureOf(0, {320, 200}));
    writer.finish();
    QTRY_COMPARE_WITH_TIMEOUT(failed.count(), 1, 20000);
    QVERIFY(old.open(QIODevice::ReadOnly));
    QCOMPARE(old.readAll(), QByteArray("old"));
    QVERIFY(parts().isEmpty());
    options.source = path;
    QVERIFY(!writer.start(options));
  }

  void noPictureIsNoVideo() {
    VideoWriter writer;
    QSignalSpy failed(&writer, &VideoWriter::failed);
    QVERIFY(writer.start({m_folder.filePath("none.webm"), {320, 200}, 30.0, false, "ffmpeg"}));
    writer.finish();
    QCOMPARE(failed.count(), 1);
    QVERIFY(parts().isEmpty());
  }
};

PITCHBOARD_GUI_TEST(TestVideoWriter)

}  // namespace tst_video_writer

#include "tst_video_writer.moc"
