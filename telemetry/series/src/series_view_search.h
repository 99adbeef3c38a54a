// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The templates of View: search by time, single values, runs of neighbouring rows. Private to the
// two files that implement View.

#include <array>

#include "series_view.h"

namespace pitchboard::telemetry::series {

/// Number of rows before a time (After: at or before it). Asked again with later times it goes on
/// from where it was; rows mostly come evenly, so it guesses and then gallops.
template <bool After>
struct View::Search {
  Search(const View& of, double start) : view(of), end(of.units()) {
    // The last unit that begins before the time.
    std::size_t low = 0, high = end;
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      if (before(view.unit(middle).first, start))
        low = middle + 1;
      else
        high = middle;
    }
    unit = low == 0 ? 0 : low - 1;
  }

  std::size_t operator()(double time) {
    if (end == 0) return 0;
    while (unit + 1 < end && before(view.unit(unit + 1).first, time)) ++unit;
    const ChunkView& in = view.unit(unit);
    const double* times = in.times;
    if (!before(in.first, time)) return view.firstRow(unit);
    if (before(in.last, time)) return view.firstRow(unit) + in.rows;
    // times[low] is before, times[high] is not.
    std::uint32_t low = 0, high = in.rows - 1;
    // 0 to 1, as time lies between; not a number where the difference of two times is none.
    const double share = (time - in.first) / (in.last - in.first);
    const std::uint32_t guess = share > 0.0 ? static_cast<std::uint32_t>(share * high) : low;
    if (before(times[guess], time)) {
      low = guess;
      for (std::uint32_t step = 1; low + step < high; step *= 2) {
        if (!before(times[low + step], time)) {
          high = low + step;
          break;
        }
        low += step;
      }
    } else {
      high = guess;
      for (std::uint32_t step = 1; low + step < high; step *= 2) {
        if (before(times[high - step], time)) {
          low = high - step;
          break;
        }
        high -= step;
      }
    }
    while (high - low > 1) {
      const std::uint32_t middle = low + (high - low) / 2;
      (before(times[middle], time) ? low : high) = middle;
    }
    return view.firstRow(unit) + high;
  }

 private:
  static bool before(double rowTime, double time) {
    return After ? rowTime <= time : rowTime < time;
  }
  const View& view;
  std::size_t end;

 public:
  std::size_t unit;
};

/// Asks the processor for the memory that a bucket's border will need, some buckets before it is
/// looked at: of ten million rows nearly every border is a wait for memory.
struct View::Ahead {
  const View& view;
  std::uint32_t column;
  std::size_t number = 0;

  /// About where the row of this time is; times ascend. Calls `pass` for every unit on the way.
  template <class Pass>
  Place guess(double time, const Pass& pass) {
    const std::size_t end = view.units();
    while (number + 1 < end && view.unit(number + 1).first < time) pass(view.unit(++number));
    const ChunkView& in = view.unit(number);
    const double share = (time - in.first) / (in.last - in.first);
    if (!in.columns || !(share > 0.0)) return {&in, 0};
    return {&in, static_cast<std::uint32_t>(std::min(share, 1.0) * (in.rows - 1))};
  }
  void wantTimes(double time) {
    const Place at = guess(time, [&](const ChunkView& unit) {
      if (unit.columns) __builtin_prefetch(unit.columns + column);
    });
    __builtin_prefetch(at.unit->times + at.row);
  }
  template <class T>
  void wantValues(double time) {
    const Place at = guess(time, [&](const ChunkView& unit) {
      if (unit.columns) unit.columns[column].want();
    });
    if (at.unit->columns) at.unit->columns[column].want<T>(at.row, at.unit->blocks);
  }
};

template <class T>
T View::stagedValue(std::uint32_t column, std::uint32_t row) const {
  const Layout& layout = *m_state->layout;
  const std::uint32_t index = layout.slots[column].index;
  if constexpr (sizeof(T) == 8) {
    return m_state->staging->values[std::size_t{row} * layout.keptValues + index];
  } else {
    return std::bit_cast<T>(m_state->staging->words[std::size_t{row} * layout.keptWords + index]);
  }
}

template <class T>
T View::value(std::uint32_t column, std::size_t row) const {
  const Place at = place(row);
  return at.unit->columns ? at.unit->columns[column].at<T>(at.row, at.unit->blocks)
                          : stagedValue<T>(column, at.row);
}

template <class T>
void View::minMax(std::uint32_t column, std::size_t begin, std::size_t end, MinMax<T>& out) const {
  while (begin < end) {
    const auto [unit, first] = place(begin);
    const auto stop =
        static_cast<std::uint32_t>(std::min<std::size_t>(unit->rows, first + (end - begin)));
    if (unit->columns) {
      unit->columns[column].range<T>(first, stop, unit->blocks, out);
    } else {
      for (std::uint32_t row = first; row < stop; ++row) {
        const T v = stagedValue<T>(column, row);
        out.add(v, v);
      }
    }
    begin += stop - first;
  }
}

/// Calls work(times, values, constant, count) for neighbouring rows in order: `values` is null
/// where all of them have the value `constant`. Stops when it returns false.
template <class T, class Work>
void View::runs(std::uint32_t column, std::size_t begin, std::size_t end, const Work& work) const {
  while (begin < end) {
    const Place at = place(begin);
    const std::uint32_t inBlock = at.row % blockRows;
    const auto count = static_cast<std::uint32_t>(
        std::min<std::size_t>(end - begin, std::min(at.unit->rows - at.row, blockRows - inBlock)));
    const double* times = at.unit->times + at.row;
    bool more = true;
    if (!at.unit->columns) {
      std::array<T, blockRows> staged;
      for (std::uint32_t i = 0; i < count; ++i) staged[i] = stagedValue<T>(column, at.row + i);
      more = work(times, staged.data(), T{}, count);
    } else {
      const Column& data = at.unit->columns[column];
      const std::uint32_t block = at.row / blockRows;
      if (!data.isConstant() && data.isRaw(block)) {
        more = work(times, data.raw<T>(block, at.unit->blocks) + inBlock, T{}, count);
      } else {
        more =
            work(times, static_cast<const T*>(nullptr), data.at<T>(at.row, at.unit->blocks), count);
      }
    }
    if (!more) return;
    begin += count;
  }
}

template <class T>
std::size_t View::lastChangedRow(std::uint32_t column) const {
  const auto same = [](T a, T b) {
    if constexpr (std::is_floating_point_v<T>)
      return a == b || (std::isnan(a) && std::isnan(b));
    else
      return a == b;
  };
  const T last = value<T>(column, m_rows - 1);
  std::size_t row = m_rows - 1;  // has the last value, and so have all after it
  while (row > 0) {
    const Place before = place(row - 1);
    const Column* kept = before.unit->columns ? before.unit->columns + column : nullptr;
    std::uint32_t begin = before.row;  // rows [begin, before.row] of the unit have one value
    if (kept && kept->isConstant())
      begin = 0;
    else if (kept && !kept->isRaw(before.row / blockRows))
      begin = before.row / blockRows * blockRows;
    if (!same(value<T>(column, row - 1), last)) return row;
    row -= before.row - begin + 1;
  }
  return 0;
}

}  // namespace pitchboard::telemetry::series
