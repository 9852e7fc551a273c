"""The page to try calls on finds operations by their words, shows no padlock where no key is set, and leads on."""

import pytest
from playwright.sync_api import expect

from tests.studio.browser import Studio

FOUND = """(path) => {
  const paths = [...document.querySelectorAll(".opblock-summary-path")].map((one) => one.innerText);
  return paths.length < 10 && paths.some((one) => one.replaceAll("\u200b", "") === path);
}"""


@pytest.mark.slow
def test_operations_are_found_by_words_of_path_name_or_description(studio: Studio) -> None:
    page = studio.page
    page.goto(f"{studio.url}/docs")
    page.locator(".opblock").first.wait_for()
    all_of_them = page.locator(".opblock").count()
    assert page.locator(".authorization__btn, .auth-wrapper").count() == 0
    groups = [heading.split("\n")[0] for heading in page.locator(".opblock-tag").all_inner_texts()]
    assert groups == ["Robots", "Scenes", "DH tables", "Kinematics", "Course", "Jobs", "Service"]
    field = page.get_by_label("Find an operation")
    for words, path in {
        "FORCE ellipsoids": "/v1/robots/{robot}/manipulability",  # of the description
        "inverse kine": "/v1/robots/{robot}/ik",  # of the name
        "to-urdf": "/v1/dh/to-urdf",  # of the path
    }.items():
        field.fill(words)
        page.wait_for_function(FOUND, arg=path, polling=50)  # what was found before may be less than ten too
    field.fill("no such words")
    page.locator(".opblock").first.wait_for(state="detached")
    field.fill("")
    expect(page.locator(".opblock")).to_have_count(all_of_them)
    page.get_by_role("link", name="Handbook").click()
    page.wait_for_url(f"{studio.url}/handbook/")
