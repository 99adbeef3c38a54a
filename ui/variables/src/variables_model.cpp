// SPDX-License-Identifier: GPL-3.0-or-later
#include "variables_model.h"

#include <QMimeData>
#include <algorithm>

#include <telemetry/series/group_order.h>
#include <ui/base/plot_target.h>
#include <ui/base/robot_text.h>

#include "variable_node.h"
#include "variable_text.h"

namespace pitchboard::ui {
namespace {

using telemetry::GroupId;
using telemetry::GroupInfo;

// Categories that people look for first; the others follow as they come.
int categoryRank(const std::string& category) {
  static constexpr const char* order[] = {"Vision",   "Belief",        "Localization",
                                          "Decision", "Planning",      "IMU",
                                          "Control",  "Communication", "Advisor"};
  int rank = 0;
  for (const char* known : order) {
    if (category == known) return rank;
    ++rank;
  }
  return rank;
}

int groupRank(const GroupInfo& info) {
  if (info.name == "match") return 2;
  return factsOf(info).number != 0 ? 0 : 1;
}

bool isListedBefore(const VariableNode& group, const VariableNode& other) {
  if (group.rank != other.rank) return group.rank < other.rank;
  if (telemetry::isListedBefore(group.view->info(), other.view->info())) return true;
  return !telemetry::isListedBefore(other.view->info(), group.view->info()) &&
         group.group < other.group;
}

}  // namespace

VariablesModel::VariablesModel(QObject* parent) : QAbstractItemModel(parent) {}
VariablesModel::~VariablesModel() = default;

VariableNode* VariablesModel::node(const QModelIndex& index) {
  return static_cast<VariableNode*>(index.internalPointer());
}

void VariablesModel::setStore(std::shared_ptr<const telemetry::SeriesStore> store,
                              const SourceKind& kind) {
  beginResetModel();
  m_groups.clear();
  m_store = std::move(store);
  m_kind = kind;
  m_revision = 0;
  m_now = 0.0;
  m_nextGroup = 0;
  endResetModel();
  updateGroups();
}

std::unique_ptr<VariableNode> VariablesModel::makeGroup(
    GroupId id, std::shared_ptr<const telemetry::GroupView> view) const {
  auto group = std::make_unique<VariableNode>();
  group->group = id;
  group->view = std::move(view);
  const GroupInfo& info = group->view->info();
  for (const telemetry::ColumnInfo& column : info.columns) group->columns.push_back(column.name);
  group->name = group->path = QString::fromStdString(info.name);
  group->rank = groupRank(info);
  const auto categoryOf = [&group](const std::string& text) {
    const QString name = text.empty() ? QStringLiteral("Other") : QString::fromStdString(text);
    for (const auto& category : group->children) {
      if (category->name == name) return category.get();
    }
    auto category = std::make_unique<VariableNode>();
    category->kind = Kind::Category;
    category->parent = group.get();
    category->rank = categoryRank(text);
    category->name = name;
    category->path = group->name + QLatin1Char('\n') + name;
    group->children.push_back(std::move(category));
    return group->children.back().get();
  };
  // An attached blackboard is known by its key.
  const QString key = attachedKey(info);
  std::uint32_t column = 0;
  for (const telemetry::ColumnInfo& columnInfo : info.columns) {
    VariableNode* category = categoryOf(columnInfo.category);
    auto variable = std::make_unique<VariableNode>();
    variable->kind = Kind::Variable;
    variable->parent = category;
    variable->row = static_cast<int>(category->children.size());
    variable->name = QString::fromStdString(columnInfo.name);
    variable->path = group->name + QLatin1Char('/') + variable->name;
    variable->column = column++;
    variable->info = columnInfo;
    variable->searchText =
        (group->name + QLatin1Char('\n') + category->name + QLatin1Char('\n') + variable->name +
         QLatin1Char('\n') + QString::fromStdString(columnInfo.unit) + QLatin1Char('\n') + key)
            .toLower();
    category->children.push_back(std::move(variable));
  }
  for (const auto& category : group->children) {
    category->neverSet = static_cast<int>(category->children.size());
    auto rest = std::make_unique<VariableNode>();
    rest->kind = Kind::Rest;
    rest->parent = category.get();
    rest->row = category->neverSet;
    rest->path = category->path + QStringLiteral("\nnever set");
    rest->searchText = group->name.toLower() + QLatin1Char('\n');
    category->children.push_back(std::move(rest));
  }
  std::stable_sort(group->children.begin(), group->children.end(),
                   [](const auto& a, const auto& b) { return a->rank < b->rank; });
  int row = 0;
  for (const auto& category : group->children) category->row = row++;
  return group;
}

void VariablesModel::renumber() {
  int row = 0;
  for (const auto& group : m_groups) group->row = row++;
}

void VariablesModel::updateGroups() {
  if (!m_store) return;
  const std::uint64_t revision = m_store->groupsRevision();
  if (revision == m_revision && m_revision != 0) return;
  m_revision = revision;
  findFavourites();
  // A group whose columns changed is listed anew.
  for (std::size_t i = m_groups.size(); i-- > 0;) {
    const VariableNode& known = *m_groups[i];
    const auto view = m_store->view(known.group);
    const std::string name = known.name.toStdString();
    const bool isListed =
        view && view->info().name == name && m_store->findGroup(name) == known.group;
    const auto hasItsColumns = [&] {
      return std::ranges::equal(view->info().columns, known.columns, {},
                                &telemetry::ColumnInfo::name);
    };
    const auto hasItsOrder = [&] {
      return factsOf(view->info()).order == factsOf(known.view->info()).order;
    };
    if (isListed && hasItsOrder() && hasItsColumns()) {
      continue;
    }
    beginRemoveRows({}, static_cast<int>(i), static_cast<int>(i));
    m_groups.erase(m_groups.begin() + static_cast<std::ptrdiff_t>(i));
    renumber();
    endRemoveRows();
  }
  const auto count = static_cast<GroupId>(m_store->groups());
  for (GroupId id = 0; id < count; ++id) {
    const bool shown = std::any_of(m_groups.begin(), m_groups.end(),
                                   [id](const auto& group) { return group->group == id; });
    if (shown) continue;
    auto view = m_store->view(id);
    if (!view || m_store->findGroup(view->info().name) != id) continue;
    auto group = makeGroup(id, std::move(view));
    lookForSet(*group);
    const auto place = std::find_if(m_groups.begin(), m_groups.end(), [&group](const auto& other) {
      return isListedBefore(*group, *other);
    });
    const int row = static_cast<int>(place - m_groups.begin());
    beginInsertRows({}, row, row);
    m_groups.insert(place, std::move(group));
    renumber();
    endInsertRows();
  }
}

/// Rows of favourites are found when groups have come or changed their names.
void VariablesModel::findFavourites() {
  m_favouriteIds.clear();
  for (const QString& name : m_favourites) {
    const auto id = m_store ? findVariable(*m_store, name) : std::nullopt;
    if (id) m_favouriteIds.emplace(*id, name);
  }
}

void VariablesModel::setFavourites(const QStringList& names) {
  m_favourites = QSet<QString>(names.begin(), names.end());
  findFavourites();
  if (!m_groups.empty()) emit dataChanged(index(0, Name), index(rowCount() - 1, Name));
  emit favouritesChanged();
}

bool VariablesModel::isFavourite(const VariableNode& variable) const {
  return m_favouriteIds.contains({variable.owner()->group, variable.column});
}

QStringList VariablesModel::favourites() const {
  QStringList names(m_favourites.begin(), m_favourites.end());
  names.sort();
  return names;
}

void VariablesModel::toggleFavourites(const QModelIndexList& indexes) {
  QModelIndexList variables;
  for (const QModelIndex& index : indexes) {
    if (kindOf(index) == Kind::Variable && index.column() == Name) variables << index;
  }
  if (variables.isEmpty()) return;
  // Several at once end up equal: all starred, unless all were.
  const bool all = std::all_of(variables.begin(), variables.end(),
                               [this](const auto& index) { return isFavourite(*node(index)); });
  for (const QModelIndex& index : variables) {
    const VariableNode& variable = *node(index);
    const auto [begin, end] =
        m_favouriteIds.equal_range({variable.owner()->group, variable.column});
    for (auto known = begin; all && known != end; ++known) m_favourites.remove(known->second);
    if (!all) m_favourites.insert(variable.path);
    emit dataChanged(index, index);
  }
  findFavourites();
  emit favouritesChanged();
}

void VariablesModel::setNote(const QString& group, const GroupNote& note) {
  if (m_notes.value(group) == note) return;
  if (note == GroupNote{})
    m_notes.remove(group);
  else
    m_notes.insert(group, note);
  const QModelIndex row = find(group);
  if (row.isValid()) emit dataChanged(row, row.siblingAtColumn(columns - 1));
}

VariablesModel::Kind VariablesModel::kindOf(const QModelIndex& index) const {
  return index.isValid() ? node(index)->kind : Kind::Group;
}

const telemetry::ColumnInfo* VariablesModel::columnOf(const QModelIndex& index) const {
  return index.isValid() && kindOf(index) == Kind::Variable ? &node(index)->info : nullptr;
}

std::shared_ptr<const telemetry::GroupView> VariablesModel::groupOf(
    const QModelIndex& index) const {
  return index.isValid() ? node(index)->owner()->view : nullptr;
}

const QString& VariablesModel::searchText(const QModelIndex& index) const {
  return node(index)->searchText;
}

bool VariablesModel::wasNeverSet(const QModelIndex& variable) const {
  return !node(variable)->wasSet;
}

int VariablesModel::neverSetCount(const QModelIndex& index) const {
  const VariableNode* row = node(index);
  return (row->kind == Kind::Rest ? row->parent : row)->neverSet;
}

void VariablesModel::setRestShown(const QSet<QString>& categories) {
  m_restShown = categories;
  for (const auto& group : m_groups) {
    for (const auto& category : group->children) {
      const QModelIndex rest = indexOf(category->children.back().get(), Name);
      emit dataChanged(rest, rest);
    }
  }
}

double VariablesModel::lastChange(const QModelIndex& index) const {
  return node(index)->lastChange;
}

int VariablesModel::variableCount() const {
  int count = 0;
  for (const auto& group : m_groups) {
    forEachVariable(*group, [&count](const VariableNode&) { ++count; });
  }
  return count;
}

QStringList VariablesModel::variableNames(const QModelIndexList& indexes) {
  QStringList names;
  for (const QModelIndex& index : indexes) {
    if (index.column() != Name || index.data(PathRole).isNull()) continue;
    const QString path = index.data(PathRole).toString();
    if (path.contains(QLatin1Char('/')) && !path.contains(QLatin1Char('\n'))) names << path;
  }
  return names;
}

QModelIndex VariablesModel::find(const QString& path) const {
  for (const auto& group : m_groups) {
    if (path == group->path) return indexOf(group.get(), Name);
    if (!path.startsWith(group->name)) continue;
    for (const auto& category : group->children) {
      if (path == category->path) return indexOf(category.get(), Name);
      for (const auto& variable : category->children) {
        if (path == variable->path) return indexOf(variable.get(), Name);
      }
    }
  }
  return {};
}

QModelIndex VariablesModel::indexOf(const VariableNode* wanted, int column) const {
  return createIndex(wanted->row, column, wanted);
}

QModelIndex VariablesModel::index(int row, int column, const QModelIndex& parent) const {
  if (!hasIndex(row, column, parent)) return {};
  const auto& rows = parent.isValid() ? node(parent)->children : m_groups;
  return createIndex(row, column, rows[static_cast<std::size_t>(row)].get());
}

QModelIndex VariablesModel::parent(const QModelIndex& child) const {
  if (!child.isValid()) return {};
  const VariableNode* above = node(child)->parent;
  return above != nullptr ? indexOf(above, Name) : QModelIndex();
}

int VariablesModel::rowCount(const QModelIndex& parent) const {
  if (!parent.isValid()) return static_cast<int>(m_groups.size());
  return parent.column() == Name ? static_cast<int>(node(parent)->children.size()) : 0;
}

int VariablesModel::columnCount(const QModelIndex&) const {
  return columns;
}

QStringList VariablesModel::mimeTypes() const {
  return {variablesMimeType};
}

QMimeData* VariablesModel::mimeData(const QModelIndexList& indexes) const {
  const QStringList names = variableNames(indexes);
  if (names.isEmpty()) return nullptr;
  auto* data = new QMimeData;
  const QString text = names.join(QLatin1Char('\n'));
  data->setData(variablesMimeType, text.toUtf8());
  data->setText(text);
  return data;
}

}  // namespace pitchboard::ui
