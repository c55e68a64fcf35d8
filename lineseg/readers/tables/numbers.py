"""Parses decimal numbers at the speed of the disk, because logs of laser scans contain little else."""

from __future__ import annotations

import re

import numpy as np

from ...kernel import entry_kernel, kernel
from ...scan import Floats

SEPARATORS = re.compile(rb"[\s,;]+")
BLANKS = bytes.maketrans(b",;", b"  ")
WORD = re.compile(rb"[^\s,;]+")
EXACT_POWERS = 10.0 ** np.arange(23)  # the powers of ten that a double represents exactly
# What Fortran prints for 1.0e+00.
FORTRAN = re.compile(rb"([-+]?(?:\d+\.\d*|\.\d+))[dD]([-+]?\d{1,3})")
HEX, JULIA = re.compile(rb"0[xX][0-9a-fA-F]{1,8}"), re.compile(rb"([-+]?(?:NaN|Inf))(?:16|32)")
MOST_DIGITS = 15  # decimal digits that a double represents exactly


def split(text: bytes) -> list[bytes]:
    """The words of a line, separated by blanks, commas or semicolons."""
    return SEPARATORS.split(text.strip(b" \t,;\r\n"))


def leading_numbers(text: bytes, count: int) -> tuple[Floats, int]:
    """The first `count` numbers of `text`, and where they end; fewer if the text ends or a word is not a number.

    The values equal those of `float` to the last bit.
    """
    values = np.empty(count)
    found, end = _plain_decimals(np.frombuffer(text, np.uint8), values, EXACT_POWERS)
    if found < count:  # there are other words, such as 1e-3 or 17 digits
        for match in WORD.finditer(text, end):
            try:
                values[found] = float(match[0])
            except ValueError:
                break
            found, end = found + 1, match.end()
            if found == count:
                break
    return values[:found], end


def all_numbers(text: bytes) -> Floats | None:
    """All numbers of a line; None if one of its words is not a number."""
    text = text.strip(b" \t,;\r\n")
    values = np.empty(len(text) // 2 + 1)
    found, end = _plain_decimals(np.frombuffer(text, np.uint8), values, EXACT_POWERS)
    if end >= len(text):
        return values[:found].copy()
    words = text[end:].translate(BLANKS).split()
    try:
        rest = list(map(float, words))
    except ValueError:
        try:
            rest = list(map(number_of, words))
        except ValueError:
            return None
    return np.concatenate((values[:found], rest))


def number_of(word: bytes) -> float:
    """The same as `float`, and the number of what Fortran, C and Julia print: 1.0D+00, 0x1F, NaN32.

    Raises ValueError for other text.
    """
    try:
        return float(word)
    except ValueError:
        if HEX.fullmatch(word.strip()):
            return float(int(word, 16))
        if (none := JULIA.fullmatch(word.strip())) is not None:
            return float(none[1])
        plain = FORTRAN.fullmatch(word.strip())
        if plain is None:
            raise
        return float(plain[1] + b"e" + plain[2])


def is_number(word: bytes) -> bool:
    try:
        number_of(word)
    except ValueError:
        return False
    return True


@kernel
def _is_separator(byte):
    return byte == 32 or 9 <= byte <= 13 or byte == 44 or byte == 59


@kernel
def _no_number(first, second, third):
    """inf, or NaN, from three small letters that say so; 0 from others."""
    if first == 105 and second == 110 and third == 102:
        return np.inf
    return np.nan if first == 110 and second == 97 and third == 110 else 0.0


@entry_kernel
def _plain_decimals(text, values, powers):
    """Fill `values` from the start of `text` while words look like -12.34, inf or nan.

    Returns their number and where they end.

    Digits are collected as an integer and divided once by a power of ten. Both are exact, so the quotient is rounded
    correctly, like that of `float`.
    """
    at = end = found = 0
    size = len(text)
    while found < len(values):
        while at < size and _is_separator(text[at]):
            at += 1
        negative = at < size and text[at] == 45
        if negative:
            at += 1
        digits = decimals = number = 0
        point = False
        while at < size:
            byte = text[at]
            if 48 <= byte <= 57:
                number = number * 10 + (byte - 48)
                digits += 1
                decimals += point
            elif byte == 46 and not point:
                point = True
            else:
                break
            at += 1
        value = 0.0
        if digits == 0 and not point and at + 3 <= size:
            value = _no_number(text[at] | 32, text[at + 1] | 32, text[at + 2] | 32)
            at += 3
        if (digits == 0 and value == 0.0) or digits > MOST_DIGITS:
            break
        if at < size and not _is_separator(text[at]):
            break
        value = number / powers[decimals] if digits else value
        values[found] = -value if negative else value
        found += 1
        end = at
    return found, end
