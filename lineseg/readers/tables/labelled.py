"""Lists of numbers with words before them: which of them hold ranges, and which of them are those of one laser."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator

from ..account import Notes
from ..lasers import laser_of
from ..source import Source
from .dialect import Row, text_of
from .headers import UNITS

# What lists of ranges are called, those of their angles, and others.
RANGES = re.compile(rb"rang|dist|scan|laser|lidar", re.IGNORECASE)
OF_ANGLES = re.compile(rb"angle|bearing|theta|azimuth", re.IGNORECASE)
OF_OTHERS = re.compile(rb"intens|qualit|remission|reflect|rssi|signal|time|stamp|pose|odom|vel|imu", re.IGNORECASE)
MOST_LASERS = 8
# What may belong to the time before it.
AFTER_TIMES = {*UNITS, "am", "pm", "utc", "z"}
# Words that do not name a laser: what a list holds, and how loud a log is.
NO_NAME = re.compile(rb"(?i)ranges?|dist\w*|scans?|laser|lidar|debug|info|warn(?:ing)?|error")
# A label before ten numbers or more, perhaps after a time; not one of the words that stand for a number.
LABEL = re.compile(
    rb"\s*((?:[-+.:\dT]*\d[-+.:\dT]*[ \t,;]+)?)(?!(?:[-+.]?inf|[-+.]?nan|null|none|na|true|false)\b)"
    rb"([\[(<]?[A-Za-z_][\w /]{0,40}[\])>]?(?:\([\w\xc2\xb0]+\))?)\s*([:=,;\s])\s*"
    rb"(?=(?:[-+.]?(?:\d|nan|inf)[^\s,;]*[\s,;]+){10})",
    re.IGNORECASE,
)
FIELD = re.compile(rb"\s*[A-Za-z_][\w ]{0,40}\s*[:=]")


def label_in(line: bytes) -> re.Match[bytes] | None:
    """What finds a time, a label and the mark after it at the beginning of a line; None if there is no label."""
    found = LABEL.match(line)
    return None if found is None or (found[1] and found[2].lower().decode("latin-1") in AFTER_TIMES) else found


def without_labels(source: Source, lines: list[bytes]) -> Callable[[bytes], bytes] | None:
    """What takes off the labels of long lists, such as "ranges: 1.5 1.6 …", if most lines have one or each line is a
    field of a message; only lists of ranges and of their angles are left."""
    found = [label_in(line) for line in lines]
    labels = [match[2].strip() for match in found if match]
    most = 2 * len(labels) > len(lines)
    if not labels or not (most or all(map(FIELD.match, lines))):
        return None
    if found[0] is None and all(match[3] not in b":=" for match in found if match):
        # The first line names the columns, of which one holds words.
        return None
    recurs = {label for label in labels if labels.count(label) > 1}

    def field_of(label: bytes) -> bytes:
        # A number that does not recur counts the scans.
        return label if label in recurs else _letters(label)

    def every() -> Iterable[bytes]:
        return (field_of(match[2].strip()) for _, line in source.lines() if (match := label_in(line)))

    kept = _kept(source, list(map(field_of, labels)), every)

    def off(line: bytes) -> bytes:
        match = label_in(line)
        if match is None:
            return line if most else b""
        return match[1] + line[match.end() :] if field_of(match[2].strip()) in kept else b""

    return off


def of_one_label(source: Source, rows: Iterable[Row], lines: list[bytes], list_: re.Pattern[bytes]) -> Iterable[Row]:
    """The rows whose lists have the usual words before them; or those of ranges, of angles, and of one laser, if their
    words differ.

    list_: finds a list, or its bracket. A list ends where the words of the next begin.
    """

    def words_in(lines: Iterable[bytes]) -> list[bytes]:
        found = (line[: match.start()].strip() for line in lines if (match := list_.search(line)))
        return [words for words in found if _letters(words)]

    if any(list_.search(line) and b"]" not in line for line in lines):
        # Lists span lines, and the first lines may have those of one laser only.
        lines = [line for _, line in source.lines()]
    before = words_in(lines)
    counts = Counter(before)
    # Otherwise numbers among the words are times, or count.
    few = len(counts) <= MOST_LASERS and min(counts.values(), default=0) > 1

    def label_of(words: bytes) -> bytes:
        return words.strip() if few else _letters(words)

    labels = list(map(label_of, before))
    if len({*labels}) < 2 or not (few or any(map(RANGES.search, labels)) or _most(labels)):
        return rows
    kept = _kept(source, labels, lambda: map(label_of, words_in(line for _, line in source.lines())))
    return _only(rows, list_, lambda words: label_of(words) in kept)


def _most(labels: list[bytes]) -> bytes | None:
    """The label that most have, None without one."""
    label, count = next(iter(Counter(labels).most_common(1)), (None, 0))
    return label if 2 * count > len(labels) else None


def _only(rows: Iterable[Row], list_: re.Pattern[bytes], is_kept: Callable[[bytes], bool]) -> Iterator[Row]:
    """The rows from words that are kept to those that are not."""
    inside = True
    for row in rows:
        found = list_.search(row.text)
        words = row.text[: found.start()] if found else b""
        inside = is_kept(words) if _letters(words) else inside
        if inside:
            yield row


def _kept(source: Source, labels: list[bytes], every: Callable[[], Iterable[bytes]]) -> set[bytes]:
    """The labels of the lists that are read: those of ranges, of one laser if there are several, and of angles.

    labels: of the first lists; every: makes those of all.
    """
    counts, usual = Counter(labels), _most(labels)
    angles = {label for label in counts if OF_ANGLES.search(label) and label != usual}
    if usual is not None:
        # Lists called after an angle and a distance have both.
        angles = set() if OF_ANGLES.search(usual) else angles
        if left := {label for label in counts if label != usual and not OF_ANGLES.search(label)}:
            tell_fields(source.notes, {usual} | angles, left)
        return {usual} | angles
    of_ranges = [label for label in counts if RANGES.search(label) and label not in angles]
    others = [label for label in counts if label not in angles and not OF_OTHERS.search(label)]
    lasers = _lasers_of(of_ranges or others or [labels[0]])
    if 1 < len(lasers) <= MOST_LASERS and "" not in lasers and _alternate(counts, lasers):
        whole = Counter(every())
        scans = {name: sum(whole[label] for label in these) for name, these in lasers.items()}
        kept = {*lasers[laser_of(source, source.reading, scans, "scans")]}
        left = counts.keys() - {label for these in lasers.values() for label in these} - angles
    else:
        kept = {*lasers.get("", next(iter(lasers.values())))}
        left = counts.keys() - kept - angles
    if left:
        tell_fields(source.notes, kept | angles, left)
    return kept | angles


def _alternate(counts: Counter[bytes], lasers: dict[str, list[bytes]]) -> bool:
    """Whether the lists of lasers are about as many, so that none of them is something else."""
    found = [sum(counts[label] for label in labels) for labels in lasers.values()]
    return min(found) > 1 and max(found) <= 2 * min(found)


def _lasers_of(labels: list[bytes]) -> dict[str, list[bytes]]:
    """The labels of each laser by what they call it, such as "front" for "[front_laser]:"; "" for those that only say
    what their lists hold."""
    words = [re.findall(rb"[^\W_]+", label) for label in labels]
    common = set.intersection(*map(set, words)) if len(words) > 1 else set()
    lasers: dict[str, list[bytes]] = {}
    for label, each in zip(labels, words, strict=True):
        name = b" ".join(word for word in each if word not in common and not NO_NAME.fullmatch(word))
        lasers.setdefault(text_of(name), []).append(label)
    return lasers


def _letters(text: bytes) -> bytes:
    return re.sub(rb"[^A-Za-z]+", b" ", text).strip()


def tell_fields(notes: Notes, kept: Iterable[bytes], others: Iterable[bytes]) -> None:
    """Tells, once, which lists are read and which are not, by what they are called."""
    if any(notice.kind == "fields" for notice in notes.notices):
        return
    read, left = (", ".join(sorted(text_of(field).rstrip(":= ") for field in fields)) for fields in (kept, others))
    notes.notice("fields", f"Only the lists called {read} were read, and not those called {left}.")
