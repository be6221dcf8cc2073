// Requests to the server. An error carries the problems, worded as on the command line.

class Refused extends Error {
  constructor(status, problems) {
    super(problems.map((problem) => problem.message).join("\n"));
    this.status = status;
    this.problems = problems;
  }
}

// Dispatches "gone" (no answer), "locked" (the server asks for its token) and "back".
export const connection = new EventTarget();
let missing = ""; // "gone" or "locked"
let waiting = null;

function lost(how) {
  if (missing !== how) {
    missing = how;
    connection.dispatchEvent(new Event(how));
  }
  if (waiting === null) waiting = setTimeout(look, 1000);
}

async function look() {
  waiting = null;
  try {
    const answer = await fetch("/api/version", { cache: "no-store" });
    if (answer.status === 401) { lost("locked"); return; }
    if (!answer.ok) throw new TypeError("not yet");
    found();
  } catch {
    lost("gone");
  }
}

function found() {
  if (!missing) return;
  missing = "";
  connection.dispatchEvent(new Event("back"));
}

// A case that is half written has problems: an answer that is expected, which no browser reports as
// an error. The server marks it by the same header.
const PROBLEMS = "X-Problems";

async function request(path, options) {
  let answer;
  try {
    answer = await fetch(path, { ...options, headers: { ...options?.headers, [PROBLEMS]: "expected" } });
  } catch (error) {
    if (error.name === "AbortError") throw error;
    lost("gone");
    throw refused(0, "The server does not answer.");
  }
  if (answer.status === 401) {
    lost("locked");
    throw refused(401, "The server asks for its token, see above.");
  }
  found();
  const problems = answer.headers.get(PROBLEMS);
  if (problems) throw new Refused(Number(problems), (await answer.json()).problems);
  if (answer.ok) return answer;
  const body = await answer.json().catch(() => ({}));
  throw body.problems ? new Refused(answer.status, body.problems) : refused(answer.status, statusText(answer));
}

const refused = (status, message) => new Refused(status, [{ path: "", line: null, message }]);

// Answers of the server that do not say why.
const statusText = ({ status, statusText: text }) =>
  status === 503 ? "The server has too much to do; try it again later." : `The server refused this: ${status} ${text}`;

// True if an error is about the case, and not about the server.
export const isAboutCase = ({ status }) => status === 400 || status === 422;

export async function get(path) {
  return (await request(path, { cache: "no-store" })).json();
}

const posted = (content, signal) => ({
  method: "POST", signal, headers: { "Content-Type": "application/json" }, body: JSON.stringify(content ?? {}),
});

export async function post(path, content, signal) {
  return (await request(path, posted(content, signal))).json();
}

export async function remove(path) {
  await request(path, { method: "DELETE" });
}

// Largest file that the server takes [bytes].
const LARGEST = 64e6;

export async function upload(file) {
  if (file.size > LARGEST) {
    const size = Math.ceil(file.size / 1e6);
    throw refused(413, `${file.name} has ${size} MB; files of up to ${LARGEST / 1e6} MB can be uploaded`);
  }
  const path = `/api/files?name=${encodeURIComponent(file.name)}`;
  return (await request(path, { method: "POST", body: file })).json();
}

// Follows a run: `onStatus` gets each status until the run is over, `onLost` is called
// if the connection fails. Returns a function that stops this.
export function follow(id, onStatus, onLost) {
  const source = new EventSource(`/api/runs/${id}/events`);
  source.onmessage = (event) => {
    const status = JSON.parse(event.data);
    if (status.over) source.close();
    onStatus(status);
  };
  source.onerror = () => {
    source.close();
    look();
    onLost();
  };
  return () => source.close();
}
