// @ts-check
// The words about live sources and robots.

export const liveText = {
  group: "Robot",
  live: "Live",
  follow: "Show the newest scan again",
  following: "Each new scan is shown as it arrives. Press Space to pause.",
  newer: (/** @type {number} */ n) => `+${n.toLocaleString("en")}`,
  rate: (/** @type {number} */ rate) => `${rate.toFixed(1)} scans/s`,
  silent: "no scans arriving",
  delay: (/** @type {number} */ seconds) =>
    Math.abs(seconds) < 1 ? `delay ${Math.round(1000 * seconds)} ms` : `delay ${seconds.toFixed(1)} s`,
  dropped: (/** @type {number} */ n) => `${n.toLocaleString("en")} dropped`,
  publishing: (/** @type {string} */ topic, /** @type {number} */ n) => `${topic}: ${n.toLocaleString("en")} sent`,
  connection: { connecting: "connecting", open: "connected", lost: "lost" },
  help: (
    /** @type {number} */ most,
    /** @type {number} */ total,
    /** @type {number} */ refused,
    /** @type {number} */ notDrawn,
  ) =>
    `The newest ${most.toLocaleString("en")} scans are kept; older ones are dropped. ${total.toLocaleString("en")} have arrived so far` +
    (notDrawn ? `, of which ${notDrawn.toLocaleString("en")} were not drawn here because newer ones had arrived` : "") +
    (refused ? `; ${refused.toLocaleString("en")} other messages were not scans.` : "."),
  delayHelp: "Time from the stamp of the last scan to its arrival here. It is right only if both clocks agree.",
  close: "Close",
  send: {
    item: "Send parameters to a robot…",
    title: "Send parameters to a robot",
    hint: "Sets the current thresholds in a running node. Nothing is sent before you press Send.",
    to: "Send to",
    node: (/** @type {string} */ source, /** @type {string} */ address) =>
      source ? `lineseg node on ${source}` : `lineseg node at ${address}`,
    bridge: "another node, over rosbridge",
    nodeHint:
      "The node uses them from the next scan on, until it ends or its file of parameters changes. To keep them, export them as ROS 2 YAML.",
    bridgeHint:
      "The values are read back. Robots are named when lineseg is started: --robot ws://localhost:9090. A lineseg node of this machine appears here by itself.",
    address: "Address of rosbridge",
    nodeName: "Node",
    ros: "ROS",
    ros2: "ROS 2: set_parameters of the node",
    ros1: "ROS 1: parameter server (a node reads it when it starts)",
    extensions: "Also send the extensions, which the authors’ program does not have",
    button: "Send",
    busy: "Sending…",
    columns: { name: "parameter", value: "sent", now: "on the robot" },
    unset: "not set",
    runs: (/** @type {string} */ method, /** @type {number} */ n) => `The node runs ${method} with these ${n} values.`,
    done: (/** @type {number} */ n) => `The robot has all ${n} values.`,
    some: (/** @type {number} */ taken, /** @type {number} */ n) => `The robot has ${taken} of ${n} values.`,
  },
  publish: {
    item: "Publish segments to the robot…",
    stop: "Stop publishing segments",
    title: "Publish segments to the robot",
    hint: "Publishes the segments of each scan, found with the thresholds of this tab, as visualization_msgs/MarkerArray with the scan’s own stamp and frame. Publishing stops when you close this tab.",
    topic: "Topic",
    button: "Publish",
  },
};
