// All tests of the page: node tests/all.mjs PROGRAM
import "./studio.test.mjs";
import "./editors.test.mjs";
import "./page.test.mjs";
import "./share.test.mjs";
