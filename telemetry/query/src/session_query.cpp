// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/query/session_query.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include <base/nearest_name.h>
#include <base/try.h>
#include <telemetry/expression/expression_unit.h>
#include <telemetry/series/group_order.h>
#include <telemetry/series/series_summary.h>

namespace pitchboard::telemetry {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint64_t rowsBetweenQuestions = 4096;
constexpr std::string_view firstRobot = "first";  // of plots

/// How much of the range lies before this time, 0 to 1.
double shareOf(TimeRange range, double time) {
  const double length = range.end - range.begin;
  return length > 0.0 ? std::clamp((time - range.begin) / length, 0.0, 1.0) : 0.0;
}

/// `B1/BELIEF_ERROR` as it is written in an expression.
std::string written(std::string_view name) {
  std::string out(name);
  if (const std::size_t slash = out.find('/'); slash != std::string::npos) out[slash] = '.';
  if (out.starts_with("each.")) out.erase(0, 5);
  return out;
}

std::pair<std::string_view, std::string_view> partsOf(std::string_view name) {
  const std::size_t slash = name.find('/');
  return {name.substr(0, slash), name.substr(slash + 1)};
}

std::optional<std::uint32_t> columnOf(const GroupInfo& group, std::string_view name) {
  const auto found = std::ranges::find(group.columns, name, &ColumnInfo::name);
  if (found == group.columns.end()) return {};
  return static_cast<std::uint32_t>(found - group.columns.begin());
}

/// The newest row of a group, as far as it is needed.
struct Input {
  std::vector<std::uint32_t> columns;
  std::map<std::uint32_t, std::size_t> places{};  ///< of the group's columns among `columns`
  std::vector<double> values{};                   ///< of the columns
  double time = -std::numeric_limits<double>::infinity();
  bool isDue = false;  ///< it has a row at the present time, whose curves are not evaluated yet
  std::vector<std::size_t> curves{};  ///< that have their samples at its rows

  void take(double at, std::span<const double> row) {
    time = at;
    std::ranges::copy(row, values.begin());
  }
};

/// An expression, and where its variables are.
struct Resolved {
  Expression expression;
  std::vector<QueryVariable> variables;
  std::vector<double> values{};
};

}  // namespace

struct SessionQuery::Impl {
  std::vector<QueryCurve> curves;
  struct Part {
    Resolved value;
    std::optional<Resolved> condition;
  };
  std::vector<Part> parts;  ///< of each curve
  std::map<GroupId, Input> inputs;
  bool readsOtherGroups = false;  ///< a curve has values of other groups than that of its times

  double evaluate(Resolved& what, double time, GroupId own) const {
    for (std::size_t i = 0; i < what.variables.size(); ++i) {
      const QueryVariable& variable = what.variables[i];
      const Input& input = inputs.at(variable.group);
      const bool isOld = variable.group != own && time - input.time > SummaryPart::maxSilence;
      what.values[i] = isOld ? unknown : input.values[input.places.at(variable.column)];
    }
    return what.expression.evaluate(time, what.values);
  }
};

SessionQuery::SessionQuery(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
SessionQuery::SessionQuery(SessionQuery&&) noexcept = default;
SessionQuery& SessionQuery::operator=(SessionQuery&&) noexcept = default;
SessionQuery::~SessionQuery() = default;

std::span<const QueryCurve> SessionQuery::curves() const {
  return m_impl->curves;
}

std::vector<std::pair<std::string, QueryVariable>> SessionQuery::variables(
    std::size_t curve) const {
  std::vector<std::pair<std::string, QueryVariable>> out;
  const auto add = [&out](const Resolved& what) {
    for (std::size_t i = 0; i < what.variables.size(); ++i) {
      out.emplace_back(what.expression.variables()[i], what.variables[i]);
    }
  };
  add(m_impl->parts[curve].value);
  if (m_impl->parts[curve].condition) add(*m_impl->parts[curve].condition);
  return out;
}

namespace {

/// Returns the columns of these expressions that are of `each`.
std::set<std::string> columnsOfEach(std::span<const std::string> texts, Error& problem) {
  std::set<std::string> out;
  for (const std::string& text : texts) {
    if (text.empty()) continue;
    const auto parsed = Expression::parse(text, eachRobot);
    if (!parsed) {
      problem = parsed.error();
      problem.message = "\"" + text + "\": " + problem.message;
      return {};
    }
    for (const std::string& name : parsed->variables()) {
      const auto [group, column] = partsOf(name);
      if (group == eachRobot) out.emplace(column);
      if (group == firstRobot) {
        problem = {ErrorCode::InvalidArgument,
                   "\"first\" is only for plots: write the robot's name, or each for every robot",
                   {}};
      }
    }
  }
  return out;
}

Error noVariable(const QueryRows& rows, std::string_view name) {
  std::vector<std::string> names;
  const bool isOfEach = name.starts_with("each/");
  for (const GroupInfo* group : rows.groups()) {
    for (const ColumnInfo& column : group->columns) {
      names.push_back(isOfEach ? column.name : group->name + '.' + column.name);
    }
  }
  const std::string wanted = written(name);
  const std::string_view near =
      nearestName(wanted, std::vector<std::string_view>(names.begin(), names.end()));
  return {ErrorCode::NotFound,
          (isOfEach ? "No robot has the variable " : "There is no variable ") + wanted +
              (near.empty() ? "." : "; did you mean " + std::string(near) + "?"),
          {}};
}

/// Returns the variable that a name of an expression means. `each`: the robot that it stands for.
Result<QueryVariable> variableOf(const QueryRows& rows, const std::string& name,
                                 std::optional<GroupId> each) {
  const auto [group, column] = partsOf(name);
  std::vector<GroupId> groups;
  if (group == eachRobot) {
    groups = {*each};
  } else {
    groups = TRY(rows.groupsNamed(group));
  }
  for (const GroupId id : groups) {
    if (const auto found = columnOf(*rows.groups()[id], column)) {
      return QueryVariable{id, *found};
    }
  }
  return tl::unexpected(noVariable(rows, name));
}

Result<Resolved> resolved(const QueryRows& rows, const std::string& text,
                          std::optional<GroupId> each) {
  Resolved out{TRY(Expression::parse(text, eachRobot)), {}};
  for (const std::string& name : out.expression.variables()) {
    out.variables.push_back(TRY(variableOf(rows, name, each)));
  }
  out.values.assign(out.variables.size(), unknown);
  return out;
}

/// Whether the expression is nothing but a variable.
bool isVariable(const std::string& text, const Expression& expression) {
  if (expression.variables().size() != 1) return false;
  return text.find_first_of("+-*/^()<>=!&|?: ") == std::string::npos || text.front() == '{';
}

void describe(const QueryRows& rows, const std::string& text, const Resolved& value,
              QueryCurve& curve) {
  const auto infoOf = [&](std::size_t i) -> const ColumnInfo& {
    const QueryVariable& variable = value.variables[i];
    return rows.groups()[variable.group]->columns[variable.column];
  };
  if (isVariable(text, value.expression)) {
    const ColumnInfo& column = infoOf(0);
    curve.unit = column.unit;
    curve.kind = column.kind;
    curve.labels = column.labels;
    return;
  }
  const auto unitOf = [&](const std::string& name) -> std::optional<std::string> {
    const auto& names = value.expression.variables();
    // A name without a group is of `each`.
    const bool isPlain = name.find('/') == std::string::npos;
    const auto found =
        std::ranges::find(names, isPlain ? std::string(eachRobot) + '/' + name : name);
    if (found == names.end()) return {};
    const ColumnInfo& column = infoOf(static_cast<std::size_t>(found - names.begin()));
    if (column.kind != ColumnKind::Number) return "1";
    return column.unit.empty() ? std::nullopt : std::optional(column.unit);
  };
  const std::string unit = unitOfExpression(text, unitOf).value_or("");
  curve.unit = unit == "1" ? "" : unit;
}

}  // namespace

Result<SessionQuery> SessionQuery::of(const QueryRows& rows, const QueryTexts& texts) {
  std::vector<QueryText> each;
  for (const std::string& value : texts.values) {
    each.push_back({value, texts.condition, texts.robots});
  }
  return of(rows, each);
}

namespace {

/// Returns the robots that have all variables of `each` in the text; one without a value if it has
/// none of them.
Result<std::vector<std::optional<GroupId>>> robotsFor(const QueryRows& rows,
                                                      const QueryText& text) {
  std::vector<bool> isChosen(rows.groups().size(), text.robots.empty());
  for (const std::string& robot : text.robots) {
    const std::vector<GroupId> groups = TRY(rows.groupsNamed(robot));
    for (const GroupId group : groups) isChosen[group] = true;
  }
  const std::array<std::string, 2> both{text.value, text.condition};
  Error problem{ErrorCode::ParseError, {}, {}};
  const std::set<std::string> columns = columnsOfEach(both, problem);
  if (!problem.message.empty()) return tl::unexpected(problem);
  std::vector<std::optional<GroupId>> robots;
  if (columns.empty()) robots.emplace_back();
  for (const std::size_t g : listedOrder(
           rows.groups(), [](const GroupInfo* group) -> const GroupInfo& { return *group; })) {
    if (columns.empty() || !isChosen[g]) continue;
    const GroupInfo& info = *rows.groups()[g];
    if (std::ranges::all_of(columns, [&](const std::string& column) {
          return columnOf(info, column).has_value();
        })) {
      robots.emplace_back(static_cast<GroupId>(g));
    }
  }
  if (!robots.empty()) return robots;
  for (const std::string& column : columns) {
    bool isThere = false;
    for (std::size_t g = 0; g < rows.groups().size(); ++g) {
      isThere = isThere || (isChosen[g] && columnOf(*rows.groups()[g], column));
    }
    if (!isThere) return tl::unexpected(noVariable(rows, std::string("each/") + column));
  }
  return failure(ErrorCode::NotFound,
                 "No robot has all variables of \"" + text.value +
                     (text.condition.empty() ? "\"." : "\" and of the condition."));
}

}  // namespace

Result<SessionQuery> SessionQuery::of(const QueryRows& rows, std::span<const QueryText> texts) {
  auto impl = std::make_unique<Impl>();
  for (std::size_t v = 0; v < texts.size(); ++v) {
    const QueryText& text = texts[v];
    const std::vector<std::optional<GroupId>> robots = TRY(robotsFor(rows, text));
    for (const std::optional<GroupId>& robot : robots) {
      Impl::Part part{TRY(resolved(rows, text.value, robot)), {}};
      if (!text.condition.empty()) part.condition = TRY(resolved(rows, text.condition, robot));
      QueryCurve curve;
      curve.value = v;
      curve.isOfEach = robot.has_value();
      curve.robot = rows.groups()[robot.value_or(part.value.variables.front().group)]->name;
      describe(rows, text.value, part.value, curve);
      impl->curves.push_back(std::move(curve));
      impl->parts.push_back(std::move(part));
    }
  }
  for (std::size_t c = 0; c < impl->parts.size(); ++c) {
    const Impl::Part& part = impl->parts[c];
    const GroupId own = part.value.variables.front().group;
    const auto need = [&](const Resolved& what) {
      for (const QueryVariable& variable : what.variables) {
        impl->readsOtherGroups = impl->readsOtherGroups || variable.group != own;
        Input& input = impl->inputs[variable.group];
        if (!input.places.emplace(variable.column, input.columns.size()).second) continue;
        input.columns.push_back(variable.column);
      }
    };
    need(part.value);
    if (part.condition) need(*part.condition);
    impl->inputs[own].curves.push_back(c);
  }
  return SessionQuery(std::move(impl));
}

bool SessionQuery::run(const QueryRows& rows, TimeRange range,
                       const std::function<bool(const QuerySample&)>& visit,
                       const std::function<bool(double)>& progress) {
  Impl& impl = *m_impl;
  std::vector<WantedColumns> wanted;
  std::vector<std::pair<GroupId, Input*>> inputs;
  for (auto& [id, input] : impl.inputs) {
    wanted.push_back({id, input.columns});
    inputs.emplace_back(id, &input);
    input.time = -std::numeric_limits<double>::infinity();
    input.isDue = false;
    input.values.assign(input.columns.size(), unknown);
  }
  if (wanted.empty()) return true;
  bool goesOn = true;
  double now = -std::numeric_limits<double>::infinity();
  // The curves of a row: evaluated when all rows of its time are known, whatever their order.
  const auto evaluate = [&](GroupId id, Input& input) {
    input.isDue = false;
    for (const std::size_t c : input.curves) {
      if (!goesOn || input.time < range.begin) return;
      Impl::Part& part = impl.parts[c];
      QuerySample sample{c, input.time, unknown, true};
      if (part.condition) {
        const double holds = impl.evaluate(*part.condition, input.time, id);
        sample.isConditioned = std::isfinite(holds) && holds != 0.0;
      }
      if (sample.isConditioned) sample.value = impl.evaluate(part.value, input.time, id);
      goesOn = visit(sample);
    }
  };
  const auto evaluateAll = [&] {
    for (auto& [id, input] : inputs) {
      if (input->isDue) evaluate(id, *input);
    }
  };
  const double lead = impl.readsOtherGroups ? SummaryPart::maxSilence : 0.0;
  std::uint64_t count = 0;
  rows.visit(
      {range.begin - lead, range.end}, wanted,
      [&](std::size_t index, double time, std::span<const double> values) {
        if (progress && ++count % rowsBetweenQuestions == 0 && !progress(shareOf(range, time))) {
          goesOn = false;
        }
        if (time > now) evaluateAll();
        now = std::max(now, time);
        Input& input = *inputs[index].second;
        // A second row of the same time.
        if (input.isDue) evaluate(inputs[index].first, input);
        input.take(time, values);
        input.isDue = !input.curves.empty();
        return goesOn;
      });
  if (goesOn) evaluateAll();
  return goesOn;
}

}  // namespace pitchboard::telemetry
