// The page of a study: its members and their verdicts, how errors fall with resolution, and what they cost.
import { aligned, Chart, type Line } from "./charts";
import type { Member, Order, Source, StudyData } from "./data";
import { duration, h, labelled, number, select, unitText } from "./dom";
import { facts, table } from "./run_page";

type Study = StudyData["study"];

const positive = (value: unknown): value is number => typeof value === "number" && value > 0;

/** A verdict or agreement of whatever form as yes, no or unknown, with its text. */
function judged(value: unknown): { good: boolean | null; text: string } {
  if (typeof value === "boolean") return { good: value, text: value ? "yes" : "no" };
  if (value && typeof value === "object") {
    const entry = value as Record<string, unknown>;
    const flag = ["passed", "pass", "holds", "good", "ok", "agrees"].map((key) => entry[key]).find((each) => typeof each === "boolean");
    const text = entry.text ?? entry.why ?? entry.value;
    const word = flag === undefined ? "–" : flag ? "yes" : "no";
    return { good: (flag as boolean | undefined) ?? null, text: text === undefined || text === null ? word : `${word}, ${typeof text === "number" ? number(text) : String(text)}` };
  }
  if (typeof value === "string") {
    const good = /^(pass|passed|yes|ok|agrees|true)/i.test(value) ? true : /^(fail|failed|no|false)/i.test(value) ? false : null;
    return { good, text: value };
  }
  return { good: null, text: "–" };
}

function verdictCell(value: unknown): HTMLElement {
  const { good, text } = judged(value);
  const mark = good === null ? "" : good ? "✓ " : "✗ ";
  return h("span", { class: good === null ? "" : good ? "good" : "bad" }, mark + text);
}

/** What was published of a quantity or a verdict, and whether we agree. */
function beside(member: Member, name: string, cell: HTMLElement): HTMLElement {
  const published = member.published?.[name], agrees = member.agrees?.[name];
  if (published === undefined || published === null) return cell;
  const mark = agrees === true ? h("span", { class: "good" }, " ✓") : agrees === false ? h("span", { class: "bad" }, " ✗") : null;
  return h("span", {}, cell, h("span", { class: "published" }, ` (published ${typeof published === "number" ? number(published) : published}`, mark, ")"));
}

/** The values of an axis as numbers, where all are numbers of one unit. */
function numbersOf(axis: Study["axes"][0]): { unit: string; of: (value: unknown) => number | null } | null {
  const read = (value: unknown) => /^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*(.*)$/i.exec(String(value));
  const parts = axis.values.map(read);
  if (parts.length < 2 || parts.some((part) => !part || part[2] !== parts[0]![2])) return null;
  return { unit: parts[0]![2], of: (value) => (value === undefined ? null : Number(read(value)?.[1] ?? NaN)) };
}

function quantityCell(member: Member, name: string, unit: string): Node {
  const value = member.quantities[name];
  return beside(member, name, h("span", {}, number(value) + (unit && typeof value === "number" ? ` ${unitText(unit)}` : "")));
}

/** Every cell leads to its member's report; by Tab only the first of a row does, or else there would be hundreds of stops. */
function linked(member: Member, content: Node | string, tab = false): Node {
  if (member.report) return h("a", { href: member.report, tabindex: tab ? undefined : -1 }, content);
  return typeof content === "string" ? document.createTextNode(content) : content;
}

function memberTable(study: Study): HTMLElement {
  const axes = study.axes.map((axis) => axis.name);
  const heads = ["member", ...axes, ...study.verdicts.map((v) => v.name), "status", ...study.quantities.map((q) => q.name), "particles", "steps", "wall time"];
  const whole = (value: number | null | undefined) => (value === null || value === undefined ? "–" : String(value));
  const rows = study.members.map((member) => [
    linked(member, member.name, true),
    ...[
      ...axes.map((axis) => (typeof member.axes[axis] === "number" ? number(member.axes[axis] as number) : String(member.axes[axis] ?? "–"))),
      ...study.verdicts.map((v) => beside(member, v.name, verdictCell(member.verdicts[v.name]))),
      h("span", { title: member.error ?? "" }, member.status),
      ...study.quantities.map((q) => quantityCell(member, q.name, q.unit ?? "")),
      whole(member.particles), whole(member.steps), member.seconds === null || member.seconds === undefined ? "–" : duration(member.seconds),
    ].map((content) => linked(member, content)),
  ]);
  return table(heads, rows, 2 + axes.length + study.verdicts.length);
}

const groupName = (member: Member, axes: string[]) => axes.map((axis) => `${axis} = ${String(member.axes[axis])}`).join(", ");

function orderOf(study: Study, quantity: string, axis: string, members: Member[], group: string): Order | undefined {
  const sameGroup = (order: Order) => {
    if (order.group === undefined || order.group === null || order.group === "") return true;
    if (typeof order.group === "object") return Object.entries(order.group as object).every(([name, value]) => members.every((member) => String(member.axes[name]) === String(value)));
    return String(order.group) === group || group.split(", ").every((part) => String(order.group).includes(part.split(" = ")[1]));
  };
  return study.orders?.find((order) => order.quantity === quantity && order.axis === axis && order.order !== null && sameGroup(order));
}

interface Points { name: string; members: Member[]; x: number[]; y: number[] }

function grouped(study: Study, axis: string, quantity: string, xOf: (member: Member) => unknown, fold: boolean): Points[] {
  const others = study.axes.map((each) => each.name).filter((name) => name !== axis);
  const groups = new Map<string, Points>();
  for (const member of study.members) {
    const x = xOf(member), value = member.quantities[quantity];
    const y = fold && typeof value === "number" ? Math.abs(value) : value;
    if (typeof x !== "number" || typeof y !== "number" || !Number.isFinite(y)) continue;
    const name = groupName(member, others);
    const points = groups.get(name) ?? { name, members: [], x: [], y: [] };
    points.members.push(member);
    points.x.push(x);
    points.y.push(y);
    groups.set(name, points);
  }
  return [...groups.values()];
}

function plot(title: string, study: Study, axis: string, quantity: string, x: { name: string; unit?: string; of: (member: Member) => unknown }, withOrders: boolean): Chart | null {
  const groups = grouped(study, axis, quantity, x.of, false);
  if (groups.length === 0) return null;
  const log = groups.every((group) => group.y.every(positive) && group.x.every(positive));
  const unit = study.quantities.find((q) => q.name === quantity)?.unit;
  const lines: { line: Omit<Line, "values">; x: number[]; y: number[] }[] = [];
  groups.forEach((group, k) => {
    lines.push({ line: { name: group.name || quantity, unit, style: "dots", colour: k }, x: group.x, y: group.y });
    const order = withOrders && log ? orderOf(study, quantity, axis, group.members, group.name) : undefined;
    if (!order || group.x.length < 2) return;
    // The line of that order through the middle of the points, both logarithmic.
    const mean = (values: number[]) => values.reduce((sum, value) => sum + Math.log(value), 0) / values.length;
    const ends = [Math.min(...group.x), Math.max(...group.x)];
    const at = (value: number) => Math.exp(mean(group.y) + order.order! * (Math.log(value) - mean(group.x)));
    lines.push({ line: { name: `order ${number(order.order, 3)}${group.name ? `, ${group.name}` : ""}`, style: "dashed", colour: k }, x: ends, y: ends.map(at) });
  });
  const joined = aligned(lines);
  return new Chart({
    title, x: { name: x.name, unit: x.unit, values: joined.x, log }, y: { name: quantity, unit, log },
    lines: lines.map(({ line }, k) => ({ ...line, values: joined.ys[k] })),
  });
}

function plots(study: Study): HTMLElement | null {
  const numeric = new Map(study.axes.map((axis) => [axis.name, numbersOf(axis)]));
  const axes = study.axes.map((each) => each.name).filter((name) => numeric.get(name));
  const quantities = study.quantities.map((q) => q.name);
  if (quantities.length === 0) return null;
  let axis = study.orders?.[0]?.axis ?? axes[0] ?? study.axes[0]?.name ?? "", quantity = study.orders?.[0]?.quantity ?? quantities[0];
  const charts = h("div", { class: "charts" });
  const draw = () => {
    const made = [
      numeric.get(axis) ? plot(`${quantity} against ${axis}`, study, axis, quantity, { name: axis, unit: numeric.get(axis)!.unit, of: (member) => numeric.get(axis)!.of(member.axes[axis]) }, true) : null,
      plot(`${quantity} against cost`, study, axis, quantity, { name: "wall time", unit: "s", of: (member) => member.seconds }, false),
    ].filter((chart) => chart !== null);
    charts.replaceChildren(...made.map((chart) => chart.element));
  };
  draw();
  return h("section", { id: "plots" }, h("h2", {}, "Error, resolution and cost"),
    h("div", { class: "controls" },
      labelled("Quantity", select(quantities.map((name) => [name, name]), quantity, (value) => { quantity = value; draw(); })),
      axes.length > 1 ? labelled("Over", select(axes.map((name): [string, string] => [name, name]), axis, (value) => { axis = value; draw(); })) : null),
    charts);
}

function orders(study: Study): HTMLElement | null {
  const rows = (study.orders ?? []).map((order) => [order.quantity, order.axis, order.group && typeof order.group === "object" ? Object.entries(order.group).map(([k, v]) => `${k} = ${v}`).join(", ") : String(order.group ?? ""), number(order.order, 3)]);
  return rows.length ? h("section", { id: "orders" }, h("h2", {}, "Fitted orders"), table(["quantity", "over", "where", "order"], rows, 3)) : null;
}

export async function studyPage(page: HTMLElement, data: StudyData, _: Source): Promise<void> {
  const { study } = data;
  document.title = `${data.title} · Undine`;
  const finished = study.members.filter((member) => member.status === "finished" || member.status === "done").length;
  page.replaceChildren(h("header", {}, h("h1", {}, data.title), facts([
    ["members", `${study.members.length}, of which ${finished} finished`],
    ["axes", study.axes.map((axis) => `${axis.name}: ${axis.values.map((value) => (typeof value === "number" ? number(value) : String(value))).join(", ")}`).join("; ")],
    ["study", study.file],
  ])));
  for (const note of data.notes) page.append(h("p", { class: "note" }, note));
  page.append(h("section", { id: "members" }, h("h2", {}, "Members"), memberTable(study)));
  const meanings = study.quantities.filter((q) => q.meaning).map((q) => [q.name, q.unit ? unitText(q.unit) : "", q.meaning!]);
  const rules = study.verdicts.filter((v) => v.rule).map((v) => [v.name, v.rule!]);
  for (const part of [plots(study), orders(study)]) if (part) page.append(part);
  if (meanings.length) page.append(h("section", {}, h("h2", {}, "Quantities"), table(["quantity", "unit", "meaning"], meanings, 3)));
  if (rules.length) page.append(h("section", {}, h("h2", {}, "Verdicts"), table(["verdict", "rule"], rules, 2)));
  const errors = study.members.filter((member) => member.error).map((member) => [member.name, member.error!]);
  if (errors.length) page.append(h("section", { id: "errors" }, h("h2", {}, "What went wrong"), table(["member", "error"], errors, 2)));
  const reasons = study.members.flatMap((member) => (member.reasons ?? []).map((reason) => [member.name, reason]));
  if (reasons.length) page.append(h("section", {}, h("h2", {}, "Where we differ from what was published"), table(["member", "reason"], reasons, 2)));
  page.dataset.ready = "true";
}
