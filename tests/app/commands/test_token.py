"""The file of a token."""

import pytest
from lineseg_app.commands.token import token_of


def test_a_token_that_others_can_read_is_told(tmp_path, capsys):
    file = tmp_path / "token"
    file.write_text("\ufeffsesame\n", encoding="utf-8")
    file.chmod(0o644)
    assert token_of(None, file) == "sesame"
    assert f"other users can read this token; `chmod 600 {file}` prevents it" in capsys.readouterr().err
    file.chmod(0o600)
    assert token_of(None, file) == "sesame"
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize(
    ("content", "sentence"),
    [(b"a\xff", "not text in UTF-8"), (b"a" * 5000, "is it the right one"), (b"\n", "is empty"), (b"a\nb", "one line")],
)
def test_a_file_that_holds_no_token_is_named(tmp_path, content, sentence):
    file = tmp_path / "token"
    file.touch(0o600)
    file.write_bytes(content)
    with pytest.raises(ValueError, match=rf"{file}: .*{sentence}"):
        token_of(None, file)
