// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which module may use which, as ARCHITECTURE.md draws it: one table, and the checks of includes
// and of the links in CMake files against it. Works on texts, so that the checks themselves can be
// tested. Any thread.

#include <QHash>
#include <QList>
#include <QRegularExpression>
#include <QSet>
#include <QString>
#include <QStringList>
#include <algorithm>

namespace layers {

/// A module or program and what it may use besides itself, the standard library and POSIX.
struct Module {
  QString folder;       ///< "robotlink/frame"
  QStringList modules;  ///< folders of other modules
  QStringList headers;  ///< beginnings of package headers: "Eigen/", "zlib.h"
};

struct SourceFile {
  QString path;  ///< from the top of the project
  QString text;
};

inline QStringList all(const QString& library) {
  static const QHash<QString, QStringList> modules{
      {"simcore", {"base", "world", "rules", "physics", "simulation"}},
      {"telemetry",
       {"sockets", "formats", "referee", "drawings", "monitor", "pb2", "series", "expression",
        "mcap", "session", "recordings", "foxglove", "statistics", "query", "video"}},
      {"robotlink",
       {"blackboard", "processes", "models",      "cognition", "rollout", "scenario", "frame",
        "match",      "live",      "session",     "import",    "report",  "serve",    "experiment",
        "learn",      "calibrate", "conformance", "capi",      "explore", "rerun",    "library"}},
      {"ui", {"base",      "sources", "field",   "robots",    "variables", "plots",   "timeline",
              "live",      "session", "noise",   "processes", "log",       "referee", "experiments",
              "calibrate", "explore", "rerun",   "rules",     "notes",     "share",   "statistics",
              "video",     "library", "mapping", "window"}}};
  QStringList folders;
  for (const QString& module : modules.value(library)) folders << library + '/' + module;
  return folders;
}

inline const QList<Module>& table() {
  static const QList<Module> modules = [] {
    const QString base = "simcore/base", world = "simcore/world", physics = "simcore/physics",
                  simulation = "simcore/simulation";
    const QString sockets = "telemetry/sockets", formats = "telemetry/formats",
                  referee = "telemetry/referee", drawings = "telemetry/drawings",
                  monitor = "telemetry/monitor", series = "telemetry/series";
    const QString board = "robotlink/blackboard", processes = "robotlink/processes",
                  models = "robotlink/models", cognition = "robotlink/cognition",
                  rollout = "robotlink/rollout", scenario = "robotlink/scenario",
                  frame = "robotlink/frame", match = "robotlink/match", live = "robotlink/live",
                  session = "robotlink/session";
    const QStringList below = all("simcore") + all("telemetry");
    const QStringList belowUi = below + all("robotlink");
    const QStringList qt{"Q"};
    QList<Module> made{
        {base, {}, {"Random123/", "nlohmann/", "sleef.h", "tl/"}},
        {world, {base}, {"tl/"}},
        {"simcore/rules", {base, world}, {}},
        {physics, {base, world}, {"box2d/"}},
        {simulation, {base, world, "simcore/rules", physics}, {}},
        {"resources", {}, {}},
        {sockets, {base}, {}},
        {formats, {base, sockets, "resources"}, {"google/protobuf/", "messages/", "nlohmann/"}},
        {referee, {base, sockets}, {"nlohmann/"}},
        {drawings, {base, formats}, {}},
        {monitor, {base, sockets, formats, drawings}, {"nlohmann/"}},
        // Shared with the robot's agent, which is small.
        {"telemetry/pb2", {base}, {}},
        {series, {base}, {}},
        {"telemetry/expression", {base}, {"muParser.h"}},
        {"telemetry/mcap", {base}, {"lz4frame.h", "zlib.h", "zstd.h"}},
        {"telemetry/session",
         {base, sockets, formats, series, "telemetry/mcap"},
         {"nlohmann/", "zlib.h"}},
        {"telemetry/recordings",
         {base, sockets, referee, "telemetry/mcap"},
         {"google/protobuf/", "nlohmann/", "sqlite3.h", "yaml-cpp/"}},
        // The only one with Beast.
        {"telemetry/foxglove", {base, sockets, formats}, {"boost/", "netdb.h", "nlohmann/"}},
        {"telemetry/statistics", {base, series}, {"Eigen/", "boost/", "unsupported/"}},
        {"telemetry/query",
         {base, series, "telemetry/expression", "telemetry/session", "telemetry/mcap",
          "telemetry/statistics"},
         {}},
        // The only one with FFmpeg.
        {"telemetry/video", {base, sockets}, {"libav", "libswscale/"}},
        {board, {base, world, series, "resources"}, {"nlohmann/"}},
        {processes, {base, board, "resources"}, {}},
        {models, {base, world, "resources"}, {"nlohmann/"}},
        {cognition,
         {base, world, sockets, formats, referee, board, processes, models, "resources"},
         {"Eigen/", "nlohmann/"}},
        {scenario,
         {base, world, simulation, referee, board, processes, models, cognition, "resources"},
         {"nlohmann/"}},
        {frame, {base, world, series, formats, drawings, monitor, board, processes, cognition}, {}},
        {match,
         all("simcore") + QStringList{sockets, referee, drawings, board, processes, models,
                                      cognition, scenario, frame},
         {}},
        {live,
         {base, world, simulation, "telemetry/foxglove", "telemetry/pb2", "telemetry/recordings",
          sockets, formats, referee, drawings, monitor, series, board, models, frame},
         {"nlohmann/"}},
        {session,
         below + QStringList{board, processes, cognition, scenario, frame, match, live},
         {"nlohmann/"}},
        {"robotlink/import",
         below + QStringList{board, cognition, scenario, frame, match, live, session},
         {"nlohmann/"}},
        // It plays beliefs, not matches.
        {rollout, {base, world, cognition, scenario}, {}},
        {"robotlink/report", below + QStringList{frame, session}, {}},
        {"robotlink/library", below + QStringList{frame, session}, {"nlohmann/"}},
        {"robotlink/serve",
         {base, world, simulation, series, "telemetry/foxglove", "telemetry/session", frame, match,
          live, session},
         {"nlohmann/"}},
        {"robotlink/experiment",
         below + QStringList{board, processes, models, cognition, scenario, frame, match, session,
                             "robotlink/report", "resources"},
         {"nlohmann/"}},
        // The only one with pagmo.
        {"robotlink/learn",
         {base, models, cognition, scenario, "robotlink/experiment", "robotlink/report"},
         {"nlohmann/", "pagmo/"}},
        {"robotlink/calibrate",
         below + QStringList{board, models, frame, live, session, "robotlink/report"},
         {"Eigen/", "nlohmann/"}},
        {"robotlink/conformance",
         all("simcore") + QStringList{board, processes, cognition, scenario, frame, match},
         {"nlohmann/", "zlib.h"}},
        {"robotlink/capi",
         {base, world, simulation, series, "telemetry/session", "telemetry/statistics", board,
          processes, models, cognition, rollout, scenario, match, session},
         {"nlohmann/"}},
        {"robotlink/explore",
         {base, world, cognition, models, rollout, scenario, frame, session},
         {}},
        {"robotlink/rerun",
         below + QStringList{board, processes, cognition, scenario, frame, match, live, session,
                             "robotlink/report", "robotlink/experiment"},
         {"nlohmann/"}},
        // What more than one program needs of its command line.
        {"app/shared", {base, models, scenario, match}, {"CLI/"}},
        // A robot's processes know nothing of matches, scenarios, sessions and windows.
        {"app/robot",
         {base, world, sockets, board, processes, models, cognition, "app/shared"},
         {"CLI/"}},
        // For the robot's computer: one small static program, of a few files of these.
        {"app/agent",
         {base, "telemetry/pb2", "telemetry/session", sockets, board, live},
         {"nlohmann/"}},
        {"app/cli", belowUi + QStringList{"app/shared"}, {"CLI/", "nlohmann/"}},
        {"app/studio",
         belowUi + QStringList{"ui/base", "ui/sources", "ui/field", "ui/session", "ui/window",
                               "app/shared"},
         {"CLI/", "Q"}},
        {"ui/base", {base, world, formats, series, frame}, qt},
        {"ui/sources", belowUi + QStringList{"ui/base"}, qt},
        {"ui/window", belowUi + all("ui"), qt},
    };
    // The modules of the window know models and words, and nothing of each other.
    for (const QString& module : all("ui")) {
      const bool listed = std::any_of(
          made.begin(), made.end(), [&module](const Module& one) { return one.folder == module; });
      if (!listed) made.append({module, belowUi + QStringList{"ui/base", "ui/sources"}, qt});
    }
    return made;
  }();
  return modules;
}

inline const Module* find(const QList<Module>& modules, const QString& folder) {
  const auto found = std::find_if(modules.begin(), modules.end(), [&folder](const Module& module) {
    return module.folder == folder;
  });
  return found == modules.end() ? nullptr : &*found;
}

/// The folder of the module of a file: "robotlink/live" and "robotlink/match/frame".
inline QString folderOfPath(const QString& path) {
  static const QRegularExpression parts(QStringLiteral("/(src|include|python)/"));
  return path.left(path.indexOf(parts)).section('/', 0, 2);
}

/// "ui/field" of "ui/field/src/ball_item.cpp", "robotlink/frame" of
/// "robotlink/match/frame/src/teams.cpp"; resources are one module.
inline QString moduleOfPath(const QString& path) {
  if (path.startsWith("resources/")) return "resources";
  const QString folder = folderOfPath(path);
  return path.startsWith("robotlink/")
             ? folder.section('/', 0, 0) + '/' + folder.section('/', -1, -1)
             : path.section('/', 0, 1);
}

/// Rooms of robotlink, the lowest first: its folders, which may only use those before them.
inline const QStringList& rooms() {
  static const QStringList names{"robot", "match", "live", "sessions", "laboratory"};
  return names;
}

/// What a room of `files` uses of a room above it.
inline QStringList roomErrors(const QList<SourceFile>& files) {
  static const QRegularExpression include(QStringLiteral("^#include <robotlink/([a-z]+)/"),
                                          QRegularExpression::MultilineOption);
  QHash<QString, qsizetype> roomOf;  // of a module
  for (const SourceFile& file : files) {
    if (!file.path.startsWith("robotlink/")) continue;
    const QString folder = folderOfPath(file.path);
    roomOf[folder.section('/', -1, -1)] = rooms().indexOf(folder.section('/', 1, 1));
  }
  QStringList wrong;
  for (const SourceFile& file : files) {
    if (!file.path.startsWith("robotlink/")) continue;
    const qsizetype room = rooms().indexOf(folderOfPath(file.path).section('/', 1, 1));
    if (room < 0) wrong << file.path + ": its folder is no room of robotlink";
    for (auto matches = include.globalMatch(file.text); matches.hasNext();) {
      const QString module = matches.next().captured(1);
      if (roomOf.value(module, -1) > room) {
        wrong << file.path + " uses robotlink/" + module + ", which is in a room above";
      }
    }
  }
  return wrong;
}

/// The module of one of our headers ("robotlink/frame" of "robotlink/frame/build_robot.h"); empty
/// for all others.
inline QString moduleOfHeader(const QString& header) {
  if (header.startsWith("base/")) return "simcore/base";
  if (header.startsWith("resources/")) return "resources";
  if (header.startsWith("app/")) return "app/shared";
  static const QStringList libraries{"simcore", "telemetry", "robotlink", "ui", "app"};
  return libraries.contains(header.section('/', 0, 0)) && header.count('/') > 0
             ? header.section('/', 0, 1)
             : QString();
}

/// Plain names such as <vector> or <unistd.h>: no folder, no upper case, and not a package's.
inline bool isSystemHeader(const QString& header) {
  static const QRegularExpression plain(QStringLiteral("^[a-z_0-9]+(\\.h)?$"));
  static const QStringList packages{"lz4frame.h", "sqlite3.h", "zlib.h", "zstd.h"};
  static const QRegularExpression folder(QStringLiteral("^(sys|linux|netinet|arpa|net)/"));
  return (plain.match(header).hasMatch() && !packages.contains(header)) ||
         folder.match(header).hasMatch();
}

inline bool beginsWithOne(const QString& text, const QStringList& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&text](const QString& one) { return text.startsWith(one); });
}

/// `files` are all of the project, so that quoted includes can be looked up.
inline QStringList includeErrors(const QList<SourceFile>& files, const QList<Module>& modules) {
  static const QRegularExpression include(
      QStringLiteral("^[ \\t]*#[ \\t]*include[ \\t]*([<\"])([^>\"]+)[>\"]"),
      QRegularExpression::MultilineOption);
  QSet<QString> paths;
  for (const SourceFile& file : files) paths.insert(file.path);
  QStringList wrong;
  for (const SourceFile& file : files) {
    const QString module = moduleOfPath(file.path);
    const Module* rule = find(modules, module);
    if (rule == nullptr) {
      wrong << file.path + ": its folder is not in the table of modules";
      continue;
    }
    for (auto matches = include.globalMatch(file.text); matches.hasNext();) {
      const auto match = matches.next();
      const QString header = match.captured(2);
      const auto line = file.text.left(match.capturedStart()).count('\n') + 1;
      const QString place = QStringLiteral("%1:%2 includes ").arg(file.path).arg(line);
      if (match.captured(1) == "\"") {
        const QString beside = file.path.section('/', 0, -2) + '/' + header;
        if (header.contains("..") ||
            (!paths.contains(beside) &&
             !paths.contains(folderOfPath(file.path) + "/src/" + header))) {
          wrong << place + '"' + header + "\", which is not of its module";
        }
        continue;
      }
      const QString other = moduleOfHeader(header);
      const bool allowed = !other.isEmpty()
                               ? other == module || rule->modules.contains(other)
                               : isSystemHeader(header) || beginsWithOne(header, rule->headers);
      if (!allowed) wrong << place + '<' + header + '>';
    }
  }
  return wrong;
}

/// What a CMake file links to a module or program.
struct Links {
  QString folder;
  QStringList publicOnes, privateOnes;  ///< "robotlink::frame", "Eigen3::Eigen"
  QStringList both() const { return publicOnes + privateOnes; }
};

inline QList<Links> linksOf(const SourceFile& cmake) {
  static const QRegularExpression call(
      QStringLiteral("(?:pitchboard|add)_(module|program|app_part|executable)\\(([^)]*)\\)"));
  static const QRegularExpression space(QStringLiteral("\\s+"));
  static const QHash<QString, QString> programs{{"pitchboard", "app/studio"},
                                                {"pitchboard-agent", "app/agent"},
                                                {"pitchboard-cli", "app/cli"},
                                                {"pitchboard-robot", "app/robot"}};
  QList<Links> found;
  for (auto matches = call.globalMatch(cmake.text); matches.hasNext();) {
    const auto match = matches.next();
    const QStringList words = match.captured(2).split(space, Qt::SkipEmptyParts);
    Links links;
    links.folder = match.captured(1) == "module" ? words.value(0) + '/' + words.value(1)
                   : match.captured(1) == "app_part"
                       ? QStringLiteral("app/shared")
                       : programs.value(words.value(0), words.value(0));
    QString part;
    for (const QString& word : words) {
      if (QStringList{"SOURCES", "PUBLIC", "PRIVATE", "LIBS"}.contains(word)) {
        part = word;
      } else if (word.contains("::")) {
        // The parts that programs share are one module.
        if (links.folder == "app/shared" && word.startsWith("app::")) continue;
        (part == "PUBLIC" ? links.publicOnes : links.privateOnes)
            << (word.startsWith("app::") ? QStringLiteral("app::shared") : word);
      }
    }
    found << links;
  }
  return found;
}

/// The header that a package's target is linked for; empty for those that any module may link.
inline QString headerOfPackage(const QString& target) {
  static const QHash<QString, QString> headers{{"Eigen3::Eigen", "Eigen/"},
                                               {"box2d::box2d", "box2d/"},
                                               {"nlohmann_json::nlohmann_json", "nlohmann/"},
                                               {"ZLIB::ZLIB", "zlib.h"},
                                               {"PkgConfig::SLEEF", "sleef.h"},
                                               {"PkgConfig::ZSTD", "zstd.h"},
                                               {"PkgConfig::LZ4", "lz4frame.h"},
                                               {"PkgConfig::sqlite3", "sqlite3.h"},
                                               {"PkgConfig::YAML", "yaml-cpp/"},
                                               {"PkgConfig::FFMPEG", "libav"},
                                               {"protobuf::libprotobuf", "google/protobuf/"},
                                               {"PkgConfig::muparser", "muParser.h"},
                                               {"Boost::headers", "boost/"},
                                               {"CLI11::CLI11", "CLI/"},
                                               {"Pagmo::pagmo", "pagmo/"},
                                               {"Threads::Threads", {}}};
  if (target.startsWith("Qt6::")) return "Q";
  return headers.value(target, target);
}

inline QStringList linkErrors(const QList<SourceFile>& cmakes, const QList<Module>& modules) {
  QStringList wrong;
  for (const SourceFile& cmake : cmakes) {
    for (const Links& links : linksOf(cmake)) {
      const Module* rule = find(modules, links.folder);
      if (rule == nullptr) {
        wrong << cmake.path + ": " + links.folder + " is not in the table of modules";
        continue;
      }
      for (const QString& target : links.both()) {
        QString module = QString(target).replace("::", "/");
        if (target == "pitchboard::resources") module = "resources";
        const bool ours = module == "resources" || !moduleOfHeader(module + '/').isEmpty();
        const QString header = ours ? QString() : headerOfPackage(target);
        const bool allowed = ours ? rule->modules.contains(module)
                                  : header.isEmpty() || rule->headers.contains(header);
        if (!allowed) wrong << cmake.path + ": " + links.folder + " links " + target;
      }
    }
  }
  return wrong;
}

/// Packages that a module links though none of its files needs it, or that it shows to others
/// though no public header needs it.
inline QStringList packageErrors(const QList<SourceFile>& cmakes, const QList<SourceFile>& files) {
  const auto includes = [&files](const QString& below, const QString& header) {
    return std::any_of(files.begin(), files.end(), [&](const SourceFile& file) {
      return file.path.startsWith(below + '/') && file.text.contains("#include <" + header);
    });
  };
  QStringList wrong;
  for (const SourceFile& cmake : cmakes) {
    for (const Links& links : linksOf(cmake)) {
      const QString folder =
          links.folder.startsWith("robotlink/") ? cmake.path.section('/', 0, -2) : links.folder;
      for (const QString& target : links.both()) {
        const QString header = headerOfPackage(target);
        // Modules of ours, and what is one package with many parts.
        if (header.isEmpty() || header == target || header == "Q") continue;
        if (!includes(folder, header)) {
          wrong << cmake.path + ": " + links.folder + " links " + target + " and does not use it";
        } else if (links.publicOnes.contains(target) && !includes(folder + "/include", header)) {
          wrong << cmake.path + ": " + links.folder + " shows " + target + " to others";
        }
      }
    }
  }
  return wrong;
}

}  // namespace layers
