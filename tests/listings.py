"""Scripts that the notebooks hand out, run in an empty file, and the numbers in a text."""

import re
import subprocess
import sys


def printed_by(listing, folder):
    """What a script prints that is pasted into an empty file in `folder`."""
    script = folder / "script.py"
    script.write_text(listing, encoding="utf-8")
    command = [sys.executable, "-I", script.name]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=60)
    assert not done.stderr, done.stderr
    return done.stdout


def numbers(text):
    """Numbers as they are printed and as the book writes them, without signs."""
    text = re.sub(r"\s*×\s*10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)", lambda power: "e" + _ascii(power[1]), text)
    return [abs(float(x)) for x in re.findall(r"\d+\.?\d*(?:e[-+]?\d+)?", text)]


def _ascii(raised):
    return raised.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))
