// Requests to the server. An error carries the problems, worded as on the command line.

class Refused extends Error {
  constructor(status, problems) {
    super(problems.map((problem) => problem.message).join("\n"));
    this.status = status;
    this.problems = problems;
  }
}

// Dispatches "gone" and "back".
export const connection = new EventTarget();
let reachable = true;
let waiting = null;

function lost() {
  if (reachable) {
    reachable = false;
    connection.dispatchEvent(new Event("gone"));
  }
  if (waiting === null) waiting = setTimeout(look, 1000);
}

async function look() {
  waiting = null;
  try {
    const answer = await fetch("/api/version", { cache: "no-store" });
    if (!answer.ok) throw new TypeError("not yet");
    found();
  } catch {
    lost();
  }
}

function found() {
  if (reachable) return;
  reachable = true;
  connection.dispatchEvent(new Event("back"));
}

async function request(path, options) {
  let answer;
  try {
    answer = await fetch(path, options);
  } catch (error) {
    if (error.name === "AbortError") throw error;
    lost();
    throw new Refused(0, [{ path: "", line: null, message: "The server does not answer." }]);
  }
  found();
  if (answer.ok) return answer;
  const body = await answer.json().catch(() => ({}));
  const unknown = [{ path: "", line: null, message: `${answer.status} ${answer.statusText}` }];
  throw new Refused(answer.status, body.problems ?? unknown);
}

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

export async function upload(file) {
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
