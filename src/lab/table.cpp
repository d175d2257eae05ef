#include "lab/table.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace lavalight {
namespace {

constexpr size_t kLineWidth = 118;

std::string numberText(double value) {
    return fmt::format("{:.6g}", value);
}

std::string cellText(const Cell& cell) {
    if (const auto* text = std::get_if<std::string>(&cell))
        return *text;
    if (const auto* count = std::get_if<uint64_t>(&cell))
        return fmt::format("{}", *count);
    if (const auto* number = std::get_if<double>(&cell))
        return numberText(*number);
    return "-";
}

bool isText(const Cell& cell) {
    return std::holds_alternative<std::string>(cell);
}

// The text in lines of at most kLineWidth characters, broken between words; the first starts with "* ".
std::string noteText(const std::string& note) {
    std::string text = "*";
    size_t length = text.size();
    for (size_t start = 0; start < note.size();) {
        const size_t end = std::min(note.find(' ', start), note.size());
        const bool fits = length + 1 + (end - start) <= kLineWidth;
        text += (fits ? " " : "\n  ") + note.substr(start, end - start);
        length = (fits ? length + 1 : 2) + (end - start);
        start = end + 1;
    }
    return text + "\n";
}

std::string csvField(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos)
        return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

// The number with all digits, for programs.
std::string csvCell(const Cell& cell) {
    if (const auto* number = std::get_if<double>(&cell))
        return std::isfinite(*number) ? fmt::format("{}", *number) : "";
    return std::holds_alternative<std::monostate>(cell) ? "" : csvField(cellText(cell));
}

nlohmann::ordered_json cellJson(const Cell& cell) {
    if (const auto* text = std::get_if<std::string>(&cell))
        return *text;
    if (const auto* count = std::get_if<uint64_t>(&cell))
        return *count;
    if (const auto* number = std::get_if<double>(&cell))
        return *number;
    return nullptr;
}

std::vector<std::string> keysOf(std::span<const Table> tables) {
    std::vector<std::string> keys;
    for (const Table& table : tables)
        for (const Column& column : table.columns)
            if (std::find(keys.begin(), keys.end(), column.key) == keys.end())
                keys.push_back(column.key);
    return keys;
}

std::string csvRow(const Table& table, const std::vector<Cell>& row, const std::vector<std::string>& keys) {
    std::string line = csvField(table.name);
    for (const std::string& key : keys) {
        const auto column = std::find_if(table.columns.begin(), table.columns.end(),
                                         [&](const Column& c) { return c.key == key; });
        line += ",";
        if (column != table.columns.end())
            line += csvCell(row[static_cast<size_t>(column - table.columns.begin())]);
    }
    return line + "\n";
}

} // namespace

std::string tableText(const Table& table) {
    std::vector<std::vector<std::string>> lines(table.rows.size() + 1);
    std::vector<size_t> widths;
    for (size_t c = 0; c < table.columns.size(); ++c) {
        lines[0].push_back(table.columns[c].heading);
        for (size_t r = 0; r < table.rows.size(); ++r)
            lines[r + 1].push_back(cellText(table.rows[r][c]));
        const auto longest = std::max_element(lines.begin(), lines.end(), [&](const auto& a, const auto& b) {
            return a[c].size() < b[c].size();
        });
        widths.push_back((*longest)[c].size());
    }
    std::string text = table.title + "\n\n";
    for (const auto& line : lines) {
        for (size_t c = 0; c < line.size(); ++c) {
            const bool isLeft = !table.rows.empty() && isText(table.rows.front()[c]);
            text += isLeft ? fmt::format("{}{:<{}}", c > 0 ? "  " : "", line[c], widths[c])
                           : fmt::format("{}{:>{}}", c > 0 ? "  " : "", line[c], widths[c]);
        }
        text.erase(text.find_last_not_of(' ') + 1);
        text += "\n";
    }
    text += table.notes.empty() ? "" : "\n";
    for (const std::string& note : table.notes)
        text += noteText(note);
    return text;
}

nlohmann::ordered_json tableJson(const Table& table) {
    nlohmann::ordered_json columns = nlohmann::ordered_json::array();
    for (const Column& column : table.columns)
        columns.push_back({{"key", column.key}, {"heading", column.heading}});
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const auto& row : table.rows) {
        nlohmann::ordered_json object = nlohmann::ordered_json::object();
        for (size_t c = 0; c < row.size(); ++c)
            object[table.columns[c].key] = cellJson(row[c]);
        rows.push_back(std::move(object));
    }
    return {{"name", table.name},
            {"title", table.title},
            {"columns", columns},
            {"rows", rows},
            {"notes", table.notes}};
}

std::string tablesCsv(std::span<const Table> tables) {
    const std::vector<std::string> keys = keysOf(tables);
    std::string text = "table";
    for (const std::string& key : keys)
        text.append(",").append(csvField(key)); // g++ 12 warns of an overflow in "," + std::string
    text += "\n";
    for (const Table& table : tables)
        for (const auto& row : table.rows)
            text += csvRow(table, row, keys);
    return text;
}

EstimatorRow estimatorRow(std::string name, const Moments& moments, const Theory& theory, double cost) {
    return {std::move(name),    moments.count,   moments.mean, theory.mean, moments.standardError(),
            moments.variance(), theory.variance, cost,         {}};
}

Cell cellOf(const std::optional<double>& value) {
    return value ? Cell(*value) : Cell();
}

Table estimatorTable(std::string name, std::string title, const std::vector<EstimatorRow>& rows,
                     const std::vector<Column>& more) {
    const bool hasTheory =
        std::any_of(rows.begin(), rows.end(), [](const auto& r) { return r.theory.has_value(); });
    Table table{std::move(name), std::move(title), {}, {}, {}};
    table.columns = {{"estimator", "estimator"}, {"samples", "samples"},         {"estimate", "estimate"},
                     {"exact", "exact"},         {"standardError", "std error"}, {"variance", "variance"}};
    if (hasTheory)
        table.columns.push_back({"theoryVariance", "by theory"});
    table.columns.push_back({"ratio", "ratio"});
    table.columns.insert(table.columns.end(), more.begin(), more.end());
    const double naive = rows.empty() ? 0.0 : rows.front().variance * rows.front().cost;
    for (const EstimatorRow& row : rows) {
        std::vector<Cell> cells{row.estimator,     row.samples,       row.estimate,
                                cellOf(row.exact), row.standardError, row.variance};
        if (hasTheory)
            cells.push_back(cellOf(row.theory));
        cells.push_back(naive > 0.0 ? Cell(row.variance * row.cost / naive) : Cell());
        cells.insert(cells.end(), row.more.begin(), row.more.end());
        table.rows.push_back(std::move(cells));
    }
    return table;
}

} // namespace lavalight
