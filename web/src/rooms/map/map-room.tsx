// Species as points of a plane, and the trees between them.
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import type { Ink, Layout } from "../../engine/protocol";
import { sayError } from "../../state/notes";
import { go } from "../../state/route";
import { start } from "../../state/species";
import { theme } from "../../state/theme";
import { Button, Check, Meter, Segmented } from "../../ui/controls";
import { download } from "../../ui/files";
import { inkImage, show, styleColor } from "../../ui/ink";
import {
  about,
  held,
  layout,
  loadPlane,
  moveTo,
  NAME,
  type Place,
  path,
  pin,
  pins,
  planes,
  point,
  row,
  setLayout,
  showSwitches,
  tomlAt,
  tree,
} from "./map-state";
import { PlaneView, type Tool, tool } from "./plane-view";

async function open(place: Place): Promise<void> {
  await start({ toml: await tomlAt(place), name: NAME });
  go("species");
}

async function save(place: Place): Promise<void> {
  download(`${NAME}_${place.join("_")}.toml`, await tomlAt(place), "application/toml");
}

function Silhouette({ ink, name, testid }: { ink: Ink; name: string; testid?: string }): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  const dark = theme();
  useEffect(() => {
    if (canvas.current)
      show(canvas.current, inkImage(ink.ink, ink.width, ink.height, styleColor("--silhouette")));
  }, [ink, dark]);
  return <canvas ref={canvas} role="img" aria-label={name} data-testid={testid} />;
}

function Weights(): JSX.Element {
  const now = about.value;
  const shown = now?.weights.filter(([, share]) => share >= 0.005).slice(0, 6) ?? [];
  return (
    <ul class="weights" aria-label="Nearest species">
      {shown.map(([name, share]) => (
        <li key={name}>
          <span>{name.replaceAll("_", " ")}</span>
          <Meter label={`Share of ${name.replaceAll("_", " ")}`} value={share} />
          <span class="share">{Math.round(share * 100)} %</span>
        </li>
      ))}
    </ul>
  );
}

const pointName = (place: Place) => `${place[0].toFixed(2)}, ${place[1].toFixed(2)}`;

function Under(): JSX.Element {
  const at = point.value;
  const now = about.value;
  if (!at) {
    return (
      <p class="empty">
        Move over the map: every point is a species. Species near each other are alike. Click to hold a point.
      </p>
    );
  }
  return (
    <>
      <div class="under">
        {tree.value && <Silhouette ink={tree.value} name={`Tree at ${pointName(at)}`} testid="under" />}
      </div>
      <p class="facts" data-testid="point">
        <strong>{pointName(at)}</strong> {held.value ? "held" : "under the pointer"}
      </p>
      {now && now.outside > 0 && (
        <p class="warning">Outside the hull of the known species: this tree is extrapolated.</p>
      )}
      <Weights />
      <div class="row wrap">
        <Button
          icon="edit"
          label="Open this species"
          kind="primary"
          onPress={() => void open(at).catch(sayError)}
          testid="open-point"
        />
        <Button icon="pin" label="Pin" onPress={() => pin(at)} />
        <Button
          icon="download"
          label="TOML"
          onPress={() => void save(at).catch(sayError)}
          testid="map-toml"
        />
        {held.value && (
          <Button
            kind="quiet"
            label="Let go"
            onPress={() => {
              held.value = false;
            }}
          />
        )}
      </div>
    </>
  );
}

function Pins(): JSX.Element | null {
  if (pins.value.length === 0) return null;
  return (
    <section class="part" aria-label="Pins">
      <h3>Pins</h3>
      <ol class="pins">
        {pins.value.map((place) => (
          <li key={place.join()}>
            <button
              type="button"
              class="textual"
              onClick={() => {
                moveTo(...place);
                held.value = true;
              }}
            >
              {pointName(place)}
            </button>
            <Button
              icon="edit"
              iconOnly
              kind="quiet"
              label={`Open ${pointName(place)}`}
              onPress={() => void open(place).catch(sayError)}
            />
            <Button
              icon="trash"
              iconOnly
              kind="quiet"
              label={`Remove ${pointName(place)}`}
              onPress={() => {
                pins.value = pins.peek().filter((each) => each !== place);
              }}
            />
          </li>
        ))}
      </ol>
    </section>
  );
}

function Row(): JSX.Element | null {
  if (path.value.length < 2) return null;
  return (
    <section class="rowoftrees" aria-label="Trees along the path">
      <ul class="strip eight">
        {row.value.map(({ at, ink }, step) => (
          <li key={at.join()}>
            <button type="button" onClick={() => void open(at).catch(sayError)}>
              <Silhouette ink={ink} name={`Tree ${step + 1} along the path`} />
              <span>{pointName(at)}</span>
            </button>
          </li>
        ))}
      </ul>
      <Button
        kind="quiet"
        icon="close"
        iconOnly
        label="Remove the path"
        onPress={() => {
          path.value = [];
        }}
      />
    </section>
  );
}

function Axes(): JSX.Element | null {
  const plane = planes.value[layout.value];
  if (!plane) return null;
  const [across, up] = plane.axes;
  const explained = plane.explained.map((share) => `${Math.round(share * 100)} %`);
  return (
    <details class="axes">
      <summary>What the axes mean</summary>
      {across && up ? (
        <>
          <p>
            To the right: {across.join(", ")}
            {explained[0] && ` (${explained[0]} of the differences)`}.
          </p>
          <p>
            Upwards: {up.join(", ")}
            {explained[1] && ` (${explained[1]})`}.
          </p>
        </>
      ) : (
        <p>The axes mean nothing here: species whose trees look alike are near each other.</p>
      )}
      {plane.switches.length > 0 && <p>Thin lines: a choice, such as the shape of leaves, switches there.</p>}
    </details>
  );
}

export function MapRoom(): JSX.Element {
  useEffect(() => {
    loadPlane().catch(sayError);
  }, [layout.value]);
  return (
    <>
      <div class="canvas map">
        <div class="toolbar floating" role="toolbar" aria-label="Map">
          <Segmented<Layout>
            label="Layout"
            value={layout.value}
            options={[
              { value: "numbers", label: "By numbers" },
              { value: "looks", label: "By looks" },
            ]}
            onPick={setLayout}
          />
          <Segmented<Tool>
            label="Tool"
            value={tool.value}
            options={[
              { value: "look", label: "Look" },
              { value: "path", label: "Draw a path" },
              { value: "pin", label: "Pin" },
            ]}
            onPick={(picked) => {
              tool.value = picked;
            }}
          />
        </div>
        <PlaneView
          onOpen={() => {
            const at = point.peek();
            if (at) open(at).catch(sayError);
          }}
        />
        <Row />
      </div>
      <aside class="panel" aria-label="Point">
        <div class="panelbody">
          <section class="part" aria-label="Tree at the point">
            <Under />
          </section>
          <Pins />
          <section class="part" aria-label="Map">
            <Check
              label="Lines where choices switch"
              checked={showSwitches.value}
              onChange={(on) => {
                showSwitches.value = on;
              }}
            />
            <Axes />
          </section>
        </div>
      </aside>
    </>
  );
}
