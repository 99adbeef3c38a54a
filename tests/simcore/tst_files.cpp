// SPDX-License-Identifier: GPL-3.0-or-later
// Files that appear whole or not at all, and files read whole.

#include <QtTest>

#include <sys/stat.h>
#include <cerrno>

#include <base/file_target.h>
#include <base/read_file.h>
#include <base/system_reason.h>

namespace tst_files {

using namespace pitchboard;

class TestFiles : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;

  std::string path(const char* name) const { return m_folder.filePath(name).toStdString(); }
  /// Hidden files too: nothing may be left behind.
  QStringList names() const {
    return QDir(m_folder.path()).entryList(QDir::Files | QDir::Hidden | QDir::System);
  }
  static std::string textOf(const std::string& file) { return readFile(file, 1000).value(); }

 private slots:
  void init() {
    for (const QString& name : names()) QVERIFY(QFile::remove(m_folder.filePath(name)));
  }

  void aNewFileAppearsAtTheEnd() {
    auto target = FileTarget::at(path("a"), IfExists::Refuse);
    QVERIFY(target);
    auto file = target->open();
    QVERIFY(file && file->write("new"));
    QVERIFY(!QFile::exists(m_folder.filePath("a")));
    QVERIFY(file->close() && target->commit());
    QCOMPARE(textOf(path("a")), std::string("new"));
    QCOMPARE(names(), QStringList("a"));
  }

  void anOldFileStaysUntilTheNewOneIsWhole() {
    QVERIFY(writeFile(path("a"), "old", IfExists::Refuse));
    QVERIFY(::chmod(path("a").c_str(), 0640) == 0);
    {
      auto target = FileTarget::at(path("a"), IfExists::Replace);
      QVERIFY(target);
      auto file = target->open();
      QVERIFY(file && file->write("half"));
      QCOMPARE(textOf(path("a")), std::string("old"));
    }
    QCOMPARE(textOf(path("a")), std::string("old"));
    QCOMPARE(names(), QStringList("a"));
    QVERIFY(writeFile(path("a"), "new", IfExists::Replace));
    QCOMPARE(textOf(path("a")), std::string("new"));
    struct stat status {};
    QVERIFY(::stat(path("a").c_str(), &status) == 0);
    QCOMPARE(status.st_mode & 0777U, 0640U);
  }

  void anExistingFileIsRefusedAtTheBeginningAndAtTheEnd() {
    QVERIFY(writeFile(path("a"), "old", IfExists::Refuse));
    QCOMPARE(FileTarget::at(path("a"), IfExists::Refuse).error().code, ErrorCode::Conflict);
    auto target = FileTarget::at(path("b"), IfExists::Refuse);
    QVERIFY(target);
    auto file = target->open();
    QVERIFY(file && file->write("new") && file->close());
    QVERIFY(writeFile(path("b"), "of another program", IfExists::Refuse));
    QCOMPARE(target->commit().error().code, ErrorCode::Conflict);
    QCOMPARE(textOf(path("b")), std::string("of another program"));
    target = FileTarget::at(path("c"), IfExists::Refuse);
    QCOMPARE(names(), QStringList({"a", "b"}));
  }

  void theSourceIsNeverTheTarget_data() {
    QTest::addColumn<QString>("target");
    QTest::newRow("itself") << "source";
    QTest::newRow("other spelling") << "folder/../source";
    QTest::newRow("symbolic link") << "symbolic";
    QTest::newRow("hard link") << "hard";
    QTest::newRow("through a linked folder") << "linked/source";
  }
  void theSourceIsNeverTheTarget() {
    QFETCH(QString, target);
    QVERIFY(writeFile(path("source"), "precious", IfExists::Refuse));
    QDir(m_folder.path()).mkdir("folder");
    QVERIFY(QFile::link("source", m_folder.filePath("symbolic")));
    QFile::link(".", m_folder.filePath("linked"));
    QVERIFY(::link(path("source").c_str(), path("hard").c_str()) == 0);
    const std::string to = m_folder.filePath(target).toStdString();
    for (const IfExists ifExists : {IfExists::Replace, IfExists::Refuse}) {
      const auto refused = writeFile(to, "bad", ifExists, path("source"));
      QVERIFY(!refused);
      QCOMPARE(refused.error().code, ErrorCode::Conflict);
      QVERIFY2(refused.error().message.find("being read") != std::string::npos,
               refused.error().message.c_str());
    }
    QCOMPARE(textOf(path("source")), std::string("precious"));
  }

  void aLinkStaysALink() {
    QVERIFY(writeFile(path("real"), "old", IfExists::Refuse));
    QVERIFY(QFile::link("real", m_folder.filePath("symbolic")));
    QVERIFY(writeFile(path("symbolic"), "new", IfExists::Replace));
    QVERIFY(QFileInfo(m_folder.filePath("symbolic")).isSymLink());
    QCOMPARE(textOf(path("real")), std::string("new"));
  }

  void whatCannotBeWrittenIsReported() {
    const auto nowhere = writeFile("/nonexistent/a", "x", IfExists::Replace);
    QVERIFY(nowhere.error().text().find("/nonexistent/a: The folder does not exist") == 0);
    const auto folder = writeFile(m_folder.path().toStdString(), "x", IfExists::Replace);
    QVERIFY(folder.error().text().find(systemReason(EISDIR)) != std::string::npos);
    const auto full = writeFile("/dev/full", "x", IfExists::Replace);
    QVERIFY(full.error().text().find("disk is full") != std::string::npos);
    QVERIFY(writeFile("/dev/null", "x", IfExists::Replace));
    struct stat status {};
    QVERIFY(::stat("/dev/null", &status) == 0 && S_ISCHR(status.st_mode));
    const std::string longest = path(std::string(255, 'n').c_str());
    QVERIFY(writeFile(longest, "x", IfExists::Refuse));
  }

  void readsWholeFilesUpToALimit() {
    std::string bytes(300'000, 'b');
    bytes[1000] = '\0';
    QVERIFY(writeFile(path("a"), bytes, IfExists::Refuse));
    QVERIFY(readFile(path("a"), bytes.size()).value() == bytes);
    const auto large = readFile(path("a"), bytes.size() - 1, "The map");
    QCOMPARE(large.error().code, ErrorCode::Unsupported);
    QVERIFY(large.error().message.find("The map is larger than 299999 bytes") == 0);
    QCOMPARE(readFile("/dev/zero", 1 << 20).error().message.find("The file is larger than 1 MiB"),
             std::size_t{0});
    QVERIFY(!readFile("/proc/self/status", 1 << 20).value().empty());
    QCOMPARE(readFile(path("none"), 10).error().code, ErrorCode::NotFound);
    const auto folder = readFile(m_folder.path().toStdString(), 10);
    QCOMPARE(folder.error().code, ErrorCode::SystemError);
    QVERIFY(folder.error().message.find(systemReason(EISDIR)) != std::string::npos);
  }
};

PITCHBOARD_TEST(TestFiles)

}  // namespace tst_files

#include "tst_files.moc"
