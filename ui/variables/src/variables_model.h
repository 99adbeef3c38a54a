// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The variables of a source as a tree: robot (group) → category → variable. Values are those of the
// last refresh(), which only looks at the rows it is given, so that thousands of rows cost nothing
// while nobody sees them. UI thread only.

#include <QAbstractItemModel>
#include <QHash>
#include <QList>
#include <QSet>
#include <QStringList>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <telemetry/series/series_store.h>
#include <ui/sources/frame_source.h>

namespace pitchboard::ui {

struct VariableNode;

struct GroupNote {
  QString trouble;             ///< stands in the row
  QString detail;              ///< in its tool tip
  std::optional<double> rate;  ///< samples a second by the wall clock, instead of the source's
  bool operator==(const GroupNote&) const = default;
};

class VariablesModel : public QAbstractItemModel {
  Q_OBJECT
 public:
  enum Column { Name, Value, Unit, Rate, Age, Spark, columns };
  enum Role {
    /// "B1", "B1/Vision" with a line feed for the slash, "B1/VISION_LOST": the same in every
    /// source.
    PathRole = Qt::UserRole,
    SortRole,       ///< a number where the column has numbers
    SparkRole,      ///< QList<telemetry::SeriesBucket>, one per pixel
    FavouriteRole,  ///< bool
    ColumnRole      ///< telemetry::ColumnInfo, of a variable
  };
  /// Rest: the last row of a category, which stands for the variables that were never set.
  enum class Kind { Group, Category, Variable, Rest };

  explicit VariablesModel(QObject* parent = nullptr);
  ~VariablesModel() override;

  /// Everything again, even for the same store. A null store is an empty tree.
  void setStore(std::shared_ptr<const telemetry::SeriesStore> store, const SourceKind& kind);
  const telemetry::SeriesStore* store() const { return m_store.get(); }
  /// Takes up groups that came since; cheap when none did.
  void updateGroups();
  /// From the next refresh on values are those of this moment of the source (s); without one the
  /// newest.
  void setMoment(std::optional<double> moment) { m_moment = moment; }
  /// Reads the values of these rows (any order, parents included) and tells the views what
  /// differs. `sparkPixels`: buckets of a sparkline, 0 leaves the sparklines alone.
  void refresh(const QModelIndexList& rows, int sparkPixels);
  /// The same for values of every row, without sparklines; for sorting by value.
  void refreshAll();
  /// Looks only when each variable changed last; for a filter.
  void refreshChanges();
  /// Looks which variables were set meanwhile: those of the groups of these rows, and those of one
  /// more group, another one each time. A variable that was set stays set.
  void refreshSet(const QModelIndexList& rows);
  /// Grows whenever one was set.
  std::uint64_t setRevision() const { return m_setRevision; }
  /// Zero, or without a value, ever since the source began.
  bool wasNeverSet(const QModelIndex& variable) const;
  /// Of a category or its last row.
  int neverSetCount(const QModelIndex& index) const;
  /// What the last row of a category says and offers.
  void setRestShown(const QSet<QString>& categories);

  /// What is known of a group beside its rows; an empty note takes it away.
  void setNote(const QString& group, const GroupNote& note);

  /// Seconds that a sparkline covers.
  double sparkSeconds() const { return m_kind.sparkline; }
  /// Newest time of the source at the last refresh.
  double now() const { return m_now; }

  void setFavourites(const QStringList& names);
  QStringList favourites() const;
  void toggleFavourites(const QModelIndexList& indexes);

  /// Whether a person may edit at all; off at first.
  void setEditingAllowed(bool allowed) { m_editingAllowed = allowed; }
  /// Why no value of such a source can be edited; empty for simulated matches.
  /// Why this row's value cannot be edited, whether or not editing is allowed; empty when it can.
  QString whyNotEditable(const QModelIndex& index) const;

  Kind kindOf(const QModelIndex& index) const;
  /// Of a variable's row; nullptr for others.
  const telemetry::ColumnInfo* columnOf(const QModelIndex& index) const;
  /// Of any row: the group it belongs to, as of the last refresh.
  std::shared_ptr<const telemetry::GroupView> groupOf(const QModelIndex& index) const;
  /// "B1/VISION_BALL_DIST" for every variable among these rows.
  static QStringList variableNames(const QModelIndexList& indexes);
  /// Row of a path as PathRole gives it; invalid when there is none.
  QModelIndex find(const QString& path) const;
  int variableCount() const;

  // For filters, without the cost of data().
  /// Lower case: group, category, name and unit.
  const QString& searchText(const QModelIndex& index) const;
  /// Time of the last change at the last refresh; −∞ when unknown.
  double lastChange(const QModelIndex& index) const;

  QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
  QModelIndex parent(const QModelIndex& child) const override;
  using QObject::parent;
  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role = Qt::EditRole) override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  QStringList mimeTypes() const override;
  QMimeData* mimeData(const QModelIndexList& indexes) const override;
  Qt::DropActions supportedDragActions() const override { return Qt::CopyAction; }

 signals:
  /// A person wants this value written; the row keeps showing what is there until it changes.
  void valueEdited(const QModelIndex& index, double value);
  void favouritesChanged();

 private:
  static VariableNode* node(const QModelIndex& index);
  void findFavourites();
  bool isFavourite(const VariableNode& variable) const;
  QModelIndex indexOf(const VariableNode* node, int column) const;
  std::unique_ptr<VariableNode> makeGroup(telemetry::GroupId id,
                                          std::shared_ptr<const telemetry::GroupView> view) const;
  void renumber();
  bool read(VariableNode& variable, int sparkPixels) const;
  void lookForSet(VariableNode& group);
  QString restText(const VariableNode& row) const;
  void takeTime();
  void lookAt(VariableNode& group);
  double rateOf(const VariableNode& group) const;
  QVariant display(const VariableNode& node, int column) const;
  QVariant sortValue(const VariableNode& node, int column) const;
  QString toolTip(const QModelIndex& index) const;

  std::shared_ptr<const telemetry::SeriesStore> m_store;
  SourceKind m_kind = SourceKind::Simulate;
  std::uint64_t m_revision = 0;
  std::vector<std::unique_ptr<VariableNode>> m_groups;
  QSet<QString> m_favourites;
  std::multimap<telemetry::SeriesId, QString> m_favouriteIds;  // those that are there
  QHash<QString, GroupNote> m_notes;                           // by group
  std::optional<double> m_moment;                              // looked back at
  double m_now = 0.0;
  std::uint64_t m_round = 0;
  std::uint64_t m_setRevision = 0;
  std::size_t m_nextGroup = 0;  // to be looked at for what was set
  QSet<QString> m_restShown;    // categories whose variables that were never set are listed
  bool m_editingAllowed = false;
};

}  // namespace pitchboard::ui

Q_DECLARE_METATYPE(pitchboard::telemetry::SeriesBucket)
Q_DECLARE_METATYPE(pitchboard::telemetry::ColumnInfo)
