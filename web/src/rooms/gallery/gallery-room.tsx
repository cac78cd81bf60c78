// All species of all families. A click starts from one.
import { signal } from "@preact/signals";
import type { JSX } from "preact";
import { families } from "../../engine/catalogue";
import type { Family, SpeciesSource } from "../../engine/protocol";
import { familyAbout, familyTitle } from "../../state/families";
import { dropSpecies, mySpecies } from "../../state/library";
import { sayError } from "../../state/notes";
import { go } from "../../state/route";
import { start } from "../../state/species";
import { Button, Segmented } from "../../ui/controls";
import { Later } from "../../ui/later";
import { Thumb } from "../../ui/thumb";

type Season = "leafy" | "winter";
/** Stays while the page is open. */
const season = signal<Season>("leafy");

/** Two device pixels per pixel of the smallest card. */
const SIZE = 224;

interface CardProps {
  source: SpeciesSource;
  name: string;
  description: string;
  seed?: number;
  onDrop?: () => void;
}

function Card({ source, name, description, seed = 1, onDrop }: CardProps): JSX.Element {
  const title = name.replaceAll("_", " ");
  const open = () =>
    void start(source)
      .then(() => go("species"))
      .catch(sayError);
  return (
    <li class="card">
      <button type="button" onClick={open}>
        <Thumb
          spec={{ source, values: null }}
          seed={seed}
          season={season.value === "winter" ? "winter" : ""}
          size={SIZE}
          name={title}
        />
        <span class="cardname">{title}</span>
        <span class="carddoc">{description}</span>
      </button>
      {onDrop && <Button icon="trash" iconOnly kind="quiet" label={`Remove ${title}`} onPress={onDrop} />}
    </li>
  );
}

function Section({ family, species }: Family): JSX.Element {
  return (
    <section class="family">
      <header>
        <h2>{familyTitle(family)}</h2>
        <p>{familyAbout(family)}</p>
      </header>
      <ul class="cards">
        {species.map(({ name, description }) => (
          <Card key={name} source={{ builtin: name }} name={name} description={description} />
        ))}
      </ul>
    </section>
  );
}

export function GalleryRoom(): JSX.Element {
  return (
    <div class="sheet">
      <header class="sheethead">
        <div>
          <p class="title">Species</p>
          <p class="lead">Start from one, and make it yours.</p>
        </div>
        <Segmented<Season>
          label="Season"
          value={season.value}
          options={[
            { value: "leafy", label: "Leafy" },
            { value: "winter", label: "Winter" },
          ]}
          onPick={(picked) => {
            season.value = picked;
          }}
        />
      </header>
      {mySpecies.value.length > 0 && (
        <section class="family">
          <header>
            <h2>My species</h2>
            <p>Kept in this browser only. Download what matters to you.</p>
          </header>
          <ul class="cards">
            {mySpecies.value.map((kept) => (
              <Card
                key={kept.id}
                source={{ toml: kept.toml, name: kept.name }}
                name={kept.name}
                description="kept by you"
                onDrop={() => dropSpecies(kept.id)}
              />
            ))}
          </ul>
        </section>
      )}
      {families.map((family) => (
        <Later key={family.family}>
          <Section {...family} />
        </Later>
      ))}
    </div>
  );
}
