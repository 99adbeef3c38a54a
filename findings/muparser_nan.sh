#!/usr/bin/env bash
# muParser 2.3.3: what becomes of a NaN. Pitchboard uses NaN for unknown values, so it replaces these
# operators and functions (telemetry/expression/src/expression.cpp). Exits with 0 if muParser behaves
# as described below, with 1 if not, with 2 if it could not be tried.
#
# Seen with libmuparser 2.3.3-0.1 of Debian 12 (x is NaN):
#   x ? 1 : 0    -> 1     one would expect 0 or NaN: neither C's (x != 0) nor "unknown" is said
#                         anywhere; ParserBase jumps only if the condition == 0
#   min(x, 100)  -> nan   but min(100, x) -> 100: std::min keeps its first argument if the comparison
#   max(x, 1)    -> nan   but max(1, x)   -> 1    is false
#   sign(x)      -> 0
#   x < 1        -> 0     x == x -> 0     x != x -> 1     (as in C)
#   x && 1       -> 1     x || 0 -> 1                      (as in C)
#   x ^ 0        -> 1     1 ^ x  -> 1                      (as pow() in C)
#   1+1,5        -> 5     a decimal comma separates two results; Eval() returns the last one
set -euo pipefail

version=2.3.3-0.1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

unable() { echo "could not be tried: $1" >&2; exit 2; }
command -v g++ >/dev/null || unable "no g++"
apt-get download "libmuparser-dev=$version" "libmuparser2v5=$version" >/dev/null 2>&1 ||
  unable "apt-get download finds no libmuparser-dev $version (Debian 12, after apt-get update)"
for package in ./*.deb; do dpkg -x "$package" root; done
library=$(dirname "$(find root -name 'libmuparser.so.2*' | head -n 1)")

cat >nan.cpp <<'CODE'
#include <muParser.h>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

int main() {
  struct Row { const char* text; const char* seen; };
  const Row rows[] = {{"x ? 1 : 0", "1"},   {"min(x, 100)", "nan"}, {"min(100, x)", "100"},
                      {"max(x, 1)", "nan"}, {"max(1, x)", "1"},     {"sign(x)", "0"},
                      {"x < 1", "0"},       {"x == x", "0"},        {"x != x", "1"},
                      {"x && 1", "1"},      {"x || 0", "1"},        {"x ^ 0", "1"},
                      {"1 ^ x", "1"},       {"1+1,5", "5"},         {"x + 1", "nan"}};
  std::printf("muParser %s\n%-14s %-6s %s\n", mu::ParserVersion.c_str(), "expression", "seen",
              "described");
  int changed = 0;
  for (const Row& row : rows) {
    std::string now;
    try {
      double x = std::numeric_limits<double>::quiet_NaN();
      mu::Parser parser;
      parser.DefineVar("x", &x);
      parser.SetExpr(row.text);
      const double value = parser.Eval();
      char text[32];
      std::snprintf(text, sizeof text, "%g", value);
      now = std::isnan(value) ? "nan" : text;
    } catch (const mu::Parser::exception_type& error) {
      now = "error: " + error.GetMsg();
    }
    std::printf("%-14s %-6s %s\n", row.text, now.c_str(), row.seen);
    changed += now != row.seen;
  }
  std::printf(changed ? "%d rows have changed\n" : "as described\n", changed);
  return changed ? 1 : 0;
}
CODE
g++ -std=c++17 -Iroot/usr/include nan.cpp -L"$library" -lmuparser -Wl,-rpath,"$PWD/$library" -o nan ||
  unable "it does not compile"
echo "package: libmuparser-dev $version"
./nan
