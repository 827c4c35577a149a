// SPDX-License-Identifier: MIT
#include <utility>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/reproduce/sections.h"

namespace verdigris {

void add_commands(const Reproduced& r, const std::vector<std::string>& ids,
                  ReportSection& section) {
    BulletList list;
    for (const std::string& id : ids)
        if (r.has(id)) list.items.push_back(r.made_by(id));
    if (list.items.empty()) return;
    section.blocks.push_back(Paragraph{"Ours by, in the result folder:"});
    section.blocks.push_back(std::move(list));
}

void add_problems(const std::vector<std::string>& problems, ReportSection& section) {
    for (const std::string& problem : problems)
        section.blocks.push_back(Status{"not_available", Severity::caution, problem});
}

void add_picture(const Reproduced& r, const std::string& task, const std::filesystem::path& file,
                 Picture picture, ReportSection& section) {
    if (!r.has(task)) return;  // why is said where its numbers would stand
    constexpr std::size_t kMostBytes = std::size_t(1) << 26;
    try {
        picture.png = read_text(r.folder / r.task(task)->outputs.front() / file, kMostBytes);
    } catch (const Error& e) {
        add_problems({picture.title + ": n/a, " + std::string(e.what()) + "."}, section);
        return;
    }
    section.blocks.push_back(std::move(picture));
}

TableCell not_printed() {
    return TableCell("–");
}
TableCell paper_cell(std::optional<double> value) {
    return value ? TableCell(*value) : not_printed();
}

}  // namespace verdigris
