// Build step: writes GLSL as C++, so that the host can run what kernels run. The input is files of shaders/
// with all that they include, but for shared/, which is both languages already. Functions, constants and
// buffers become members, to be included within a struct.
//
// What is translated is what our files use, no more: parameters by reference, literals of type float,
// swizzles, constructors of structs, layout qualifiers. The C++ compiler reports the rest.
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"

namespace {

using namespace lavalight;

const std::string kAccelerator = "scene/accelerator.glsl"; // the host has one of its own

bool isWordCharacter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    for (size_t at = 0; at < text.size();) {
        const size_t end = std::min(text.find('\n', at), text.size());
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

struct Sources {
    std::filesystem::path root;
    std::set<std::string> read;   // files below the root, each once
    std::set<std::string> shared; // headers of both languages
    std::vector<std::string> lines;
};

// Appends the lines of `path` without comments, what it includes in the places of its includes.
void append(const std::string& path, Sources& sources) {
    static const std::regex include(R"re(\s*#include "([^"]+)")re");
    for (const std::string& line : linesOf(readFile(sources.root / path))) {
        std::smatch match;
        if (std::regex_match(line, match, include)) {
            const std::string& included = match[1].str();
            if (included.starts_with("shared/"))
                sources.shared.insert(included);
            else if (included != kAccelerator && sources.read.insert(included).second)
                append(included, sources);
        } else if (!line.starts_with("#version") && !line.starts_with("#extension")) {
            sources.lines.push_back(line.substr(0, line.find("//")));
        }
    }
}

// Names of the structs that a text declares.
std::set<std::string> structsIn(const std::string& text) {
    static const std::regex declaration(R"(\bstruct (\w+))");
    std::set<std::string> names;
    for (std::sregex_iterator i(text.begin(), text.end(), declaration), end; i != end; ++i)
        names.insert((*i)[1].str());
    return names;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines)
        text += line + '\n';
    return text;
}

// Declarations that C++ spells differently, line by line.
std::string withDeclarations(const std::string& text) {
    static const std::vector<std::pair<std::regex, std::string>> rules{
        {std::regex(R"(layout\([^)]*\) uniform utextureBuffer (\w+);)"), "TexelBuffer $1;"},
        {std::regex(R"(layout\([^)]*\) uniform \w+ \{ (\w+ \w+;) \};)"), "$1"},
        {std::regex(R"(layout\([^)]*\) const (\w+ \w+ = [^;]*;))"), "$1"},
        {std::regex(R"((^|\n)const )"), "$1static inline const "},
        {std::regex(R"(\b(?:in)?out (\w+) (\w+))"), "$1& $2"},
        {std::regex(R"(\bprecise )"), ""},
        {std::regex(R"(((?:\b\d+\.\d*|\.\d+)(?:e[-+]?\d+)?|\b\d+e[-+]?\d+)(?![\w.]))"), "$1f"},
        {std::regex(R"(\bsceneHas\()"), "has("},
        {std::regex(R"(#define has\(.*)"), ""},
    };
    std::string result = text;
    for (const auto& [pattern, replacement] : rules)
        result = std::regex_replace(result, pattern, replacement);
    return result;
}

size_t matching(const std::string& text, size_t open) {
    int depth = 0;
    for (size_t i = open; i < text.size(); ++i) {
        depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
        if (depth == 0)
            return i;
    }
    throw Error(fmt::format("no parenthesis ends what begins at: {}", text.substr(open, 60)));
}

// S(a, b) of a struct S becomes S{a, b}.
std::string withConstructors(std::string text, const std::set<std::string>& structs) {
    for (size_t i = 0; i < text.size(); ++i) {
        const bool startsWord = isWordCharacter(text[i]) && (i == 0 || !isWordCharacter(text[i - 1]));
        if (!startsWord)
            continue;
        size_t end = i;
        while (end < text.size() && isWordCharacter(text[end]))
            ++end;
        if (end < text.size() && text[end] == '(' && structs.contains(text.substr(i, end - i))) {
            text[matching(text, end)] = '}';
            text[end] = '{';
        }
        i = end - 1;
    }
    return text;
}

// Where the expression starts whose last character stands before `end`: names, members, calls, elements.
size_t startOfExpression(const std::string& text, size_t end) {
    size_t at = end;
    for (;;) {
        if (text[at - 1] == ')' || text[at - 1] == ']') {
            int depth = 0;
            do {
                --at;
                depth += text[at] == ')' || text[at] == ']' ? 1 : text[at] == '(' || text[at] == '[' ? -1 : 0;
            } while (depth != 0);
        }
        while (at > 0 && isWordCharacter(text[at - 1]))
            --at;
        if (at == 0 || text[at - 1] != '.')
            return at;
        --at;
    }
}

// v.zxy becomes zxy(v).
std::string withSwizzles(std::string text) {
    for (size_t dot = text.find('.'); dot != std::string::npos; dot = text.find('.', dot + 1)) {
        size_t end = dot + 1;
        while (end < text.size() && isWordCharacter(text[end]))
            ++end;
        std::string letters = text.substr(dot + 1, end - dot - 1);
        if (letters.find_first_not_of("rgba") == std::string::npos)
            for (char& letter : letters)
                letter = "xyzw"[std::string_view("rgba").find(letter)];
        const bool isSwizzle = letters.size() > 1 && letters.size() <= 4 &&
                               letters.find_first_not_of("xyzw") == std::string::npos;
        if (!isSwizzle || dot == 0)
            continue;
        const size_t start = startOfExpression(text, dot);
        const std::string call = fmt::format("{}({})", letters, text.substr(start, dot - start));
        text.replace(start, end - start, call);
        dot = start;
    }
    return text;
}

std::string translated(const std::filesystem::path& root, const std::vector<std::string>& files) {
    Sources sources{root, {}, {}, {}};
    for (const std::string& file : files)
        if (sources.read.insert(file).second)
            append(file, sources);
    std::string text = joined(sources.lines);
    std::set<std::string> structs = structsIn(text);
    for (const std::string& header : sources.shared)
        structs.merge(structsIn(readFile(root / header)));
    return "// Generated by tools/shaders_as_cpp.\n" +
           withSwizzles(withConstructors(withDeclarations(text), structs));
}

} // namespace

int main(int argc, char** argv) {
    try {
        if (argc < 4)
            throw UsageError("usage: shaders_as_cpp SHADERS OUT FILE.glsl...");
        writeFileAtomically(argv[2], translated(argv[1], {argv + 3, argv + argc}));
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "shaders_as_cpp: %s\n", error.what());
        return 1;
    }
}
