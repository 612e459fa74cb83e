"""The plugin that forbids skipping in CI."""

from __future__ import annotations

import pytest

SKIPPING_TESTS = """
import pytest

@pytest.mark.skip(reason="chromium is not installed")
def test_marked(): ...

def test_called():
    pytest.skip("chromium is not installed")

@pytest.mark.xfail(strict=True)
def test_known_fault():
    assert False

def test_fine(): ...
"""


@pytest.fixture(autouse=True)
def use_only_our_plugin(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    monkeypatch.setenv("PYTEST_PLUGINS", "tests.support.no_skips")


def test_a_skip_in_ci_is_an_error_that_names_the_test_and_the_reason(
    pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("CI", "true")
    pytester.makepyfile(SKIPPING_TESTS)
    result = pytester.runpytest("-ra")
    result.assert_outcomes(passed=1, xfailed=1, errors=1, failed=1)
    assert result.ret == pytest.ExitCode.TESTS_FAILED
    result.stdout.fnmatch_lines(
        ["ERROR *::test_marked*", "FAILED *::test_called*"], consecutive=False
    )
    result.stdout.fnmatch_lines(["*in CI nothing may be: *chromium is not installed*"])


def test_a_module_that_skips_as_a_whole_in_ci_is_an_error(
    pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("CI", "true")
    pytester.makepyfile('import pytest\npytest.importorskip("no_such_module")\n')
    result = pytester.runpytest()
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines(["*in CI nothing may be: *no_such_module*"])


def test_elsewhere_a_skip_is_a_skip(
    pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("CI", raising=False)
    pytester.makepyfile(SKIPPING_TESTS)
    pytester.runpytest().assert_outcomes(passed=1, skipped=2, xfailed=1)
